#include "hair/rendering/model_offsets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/error.h"
#include "hair/groom/resample.h"
#include "hair/groom/style/along_strand.h"
#include "hair/groom/style/strand_edits.h"
#include "hair/groom/style/strand_frames.h"

namespace hair {
namespace {

// A cubic needs 3 points beside the root; more make its fit one by arc length. The most is what a
// table of 1,024 profiles has room for.
constexpr std::uint32_t kLeastPoints = 16;
constexpr std::uint32_t kMostPoints = 4096;

// p(s) = root + c0 s + c1 s^2 + c2 s^3, s the fraction of arc length.
struct Cubic {
    glm::dvec3 root;
    glm::dmat3 coefficients;  // columns c0 to c2

    glm::dvec3 at(double s) const { return root + coefficients * glm::dvec3(s, s * s, s * s * s); }
};

// Least squares over arc length, by the trapezoidal rule.
Cubic fit(std::span<const glm::vec3> strand, const AlongStrand& along) {
    const glm::dvec3 root(strand.front());
    glm::dmat3 normal_matrix(1e-12);  // so that coinciding points don't make it singular
    glm::dmat3 moments(0.0);
    for (std::size_t i = 0; i < strand.size(); ++i) {
        const double weight = along.fraction(std::min(i + 1, strand.size() - 1)) -
                              along.fraction(std::max<std::size_t>(i, 1) - 1);
        const double s = along.fraction(i);
        const glm::dvec3 powers(s, s * s, s * s * s);
        normal_matrix += weight * glm::outerProduct(powers, powers);
        moments += weight * glm::outerProduct(glm::dvec3(strand[i]) - root, powers);
    }
    return {root, moments * glm::inverse(normal_matrix)};
}

}  // namespace

StrandSet offsetModel(const StrandSet& strands, std::uint32_t most) {
    std::vector<std::uint32_t> usable;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        if (AlongStrand(strands.strand(i)).length() > 0.0) usable.push_back(i);
    if (usable.empty()) throw engine::Error("no strand has a length");
    const std::size_t count = std::min<std::size_t>(usable.size(), most);
    std::vector<std::uint32_t> spread(count);
    for (std::size_t i = 0; i < count; ++i) spread[i] = usable[i * usable.size() / count];
    StrandSet picked = pickStrands(strands, spread);
    const std::uint32_t points = std::clamp(greatestSize(picked), kLeastPoints, kMostPoints);
    return resample(std::move(picked), points);
}

void addModelOffsets(
    std::span<const glm::vec3> strand, double length, double turn, std::span<glm::vec3> samples) {
    const AlongStrand along(strand);
    const Cubic cubic = fit(strand, along);
    std::vector<glm::vec3> smooth(strand.size());
    for (std::size_t i = 0; i < strand.size(); ++i)
        smooth[i] = glm::vec3(cubic.at(along.fraction(i)));
    const std::vector<StrandFrame> frames = strandFrames(smooth, nullptr);
    // A strand that ends where it began may have a smooth shape of next to no length.
    const double scale = length / std::max(AlongStrand(smooth).length(), 0.01 * along.length());

    const double angle = 2.0 * std::numbers::pi * turn;
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    std::vector<glm::dvec3> offsets(strand.size());
    for (std::size_t i = 0; i < strand.size(); ++i) {
        const glm::dvec3 offset = glm::dvec3(strand[i]) - cubic.at(along.fraction(i));
        const StrandFrame& frame = frames[i];
        const double x = glm::dot(offset, frame.normal);
        const double y = glm::dot(offset, frame.binormal);
        offsets[i] = scale * glm::dvec3(
                                 cosine * x - sine * y, sine * x + cosine * y,
                                 glm::dot(offset, frame.tangent));
    }
    std::size_t before = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double s = static_cast<double>(i) / static_cast<double>(samples.size() - 1);
        while (before + 2 < strand.size() && along.fraction(before + 1) <= s) ++before;
        const double from = along.fraction(before);
        const double span = along.fraction(before + 1) - from;
        const double part = span > 0.0 ? std::min((s - from) / span, 1.0) : 1.0;
        samples[i] += glm::vec3(glm::mix(offsets[before], offsets[before + 1], part));
    }
}

}  // namespace hair
