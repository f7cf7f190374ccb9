#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "hair/groom/style/clearance.h"
#include "hair/groom/parallel.h"
#include "hair/groom/style/displace.h"
#include "hair/groom/style/style.h"
#include "hair/random.h"

namespace hair::groom {
namespace {

constexpr double kDepth = 0.6;  // how far parts move into the braid, relative to how far they move
                                // across it
constexpr double kSection = 0.42;  // radius of a part, relative to its movement across the braid
constexpr double kWidth = 2.0 * (1.0 + kSection);
constexpr double kLeastLeft = 0.12;  // share of strands for which the braid is thick enough
constexpr int kStepsPerPitch = 32;

// The axes of a braid.
struct BraidAxes {
    glm::dvec3 tie;
    glm::dvec3 down;
    glm::dvec3 across;
    glm::dvec3 out;  // away from the head
};

BraidAxes axesOf(const BraidSettings& settings, const glm::dvec3& head) {
    BraidAxes axes{.tie = glm::dvec3(settings.tie)};
    const glm::dvec3 direction(settings.direction);
    axes.down = glm::length(direction) > 0.0 ? glm::normalize(direction) : glm::dvec3(0, -1, 0);
    const glm::dvec3 out = axes.tie - head;
    const glm::dvec3 flat = out - glm::dot(out, axes.down) * axes.down;
    axes.out = glm::length(flat) > 1e-6 ? glm::normalize(flat) : across(axes.down);
    axes.across = glm::cross(axes.out, axes.down);
    return axes;
}

// The place of a strand in the braid.
struct BraidPlace {
    int part = 0;
    double angle = 0.0;  // rad, in the section of the part
    double radius = 0.0;  // relative to the section's
};

// The middle of a part and its section's radius.
struct Section {
    glm::dvec3 middle;
    double radius;
};

class Braid {
public:
    // `lengths`: the length that each strand has left at the tie, m.
    Braid(const BraidSettings& settings, const BraidAxes& axes, std::vector<double> lengths)
        : axes_(axes), pitch_(settings.pitch), length_(settings.length),
          reach_(settings.width / kWidth), lengths_(std::move(lengths)) {
        std::ranges::sort(lengths_);
    }

    glm::dvec3 at(const BraidPlace& place, double u) const {
        const Section here = section(place.part, u);
        const double step = 0.02 * pitch_;
        const glm::dvec3 along = glm::normalize(
            section(place.part, u + step).middle - section(place.part, u - step).middle);
        const glm::dvec3 out = glm::normalize(axes_.out - glm::dot(axes_.out, along) * along);
        const double radius = place.radius * here.radius;
        return here.middle + radius * (std::cos(place.angle) * out +
                                       std::sin(place.angle) * glm::cross(along, out));
    }

    double step() const { return pitch_ / kStepsPerPitch; }

private:
    Section section(int part, double u) const {
        const double end = length_ > 0.0 ? length_ : 1e9;
        const double inside = std::min(u, end);
        const double phase = 2.0 * std::numbers::pi * (inside / pitch_ + part / 3.0);
        const double size = reach_ * std::sqrt(std::max(shareLeft(u), kLeastLeft));
        // The braid is bound tightly at the tie and at the end, below which the parts are one.
        const double tight = std::min(
            ease(-0.3 * pitch_, 0.5 * pitch_, u),
            0.45 + 0.55 * ease(0.0, 0.4 * pitch_, std::abs(end - u)));
        const double apart = size * tight * (1.0 - ease(end, end + 0.6 * pitch_, u));
        const double loose = ease(end, end + 2.0 * pitch_, u);
        return {
            axes_.tie + u * axes_.down + apart * std::sin(phase) * axes_.across +
                kDepth * apart * std::sin(2.0 * phase) * axes_.out,
            kSection * size * (u < end ? tight : 0.45 + 1.1 * loose)};
    }

    double shareLeft(double u) const {
        const auto shorter = std::ranges::lower_bound(lengths_, u) - lengths_.begin();
        return 1.0 - static_cast<double>(shorter) / static_cast<double>(lengths_.size());
    }

    BraidAxes axes_;
    double pitch_, length_, reach_;
    std::vector<double> lengths_;  // ascending
};

// The path of a strand over the head, from its root to where it enters the braid.
class WayToTie {
public:
    WayToTie(const Mesh* mesh, const glm::dvec3& head, const glm::dvec3& over)
        : mesh_(mesh), head_(head), over_(over) {
        if (mesh) surface_.emplace(mesh->positions, mesh->triangles);
    }

    std::vector<glm::dvec3> operator()(const glm::dvec3& root, const glm::dvec3& end) const {
        std::vector<glm::dvec3> way(kPoints);
        const glm::dvec3 a = root - head_;
        const glm::dvec3 b = end - head_;
        for (std::size_t i = 0; i < kPoints; ++i) {
            const double t = static_cast<double>(i) / (kPoints - 1);
            way[i] = mesh_ ? head_ + arc(a, b, t) : glm::mix(root, end, t);
        }
        if (!mesh_) return way;
        // Strands from farther away lie over those from nearer.
        const double height = kHeight * std::min(1.0, glm::distance(root, end) / kFar);
        for (int round = 0; round < kRounds; ++round) {
            for (std::size_t i = 1; i + 1 < kPoints; ++i)
                if (round > 0) way[i] = glm::mix(way[i], 0.5 * (way[i - 1] + way[i + 1]), 0.5);
            for (std::size_t i = 1; i + 1 < kPoints; ++i) {
                const double t = static_cast<double>(i) / (kPoints - 1);
                const double wanted = kLeast + height * ease(0.0, 0.6, t);
                const MeshPoint nearest = (*surface_)(way[i]);
                const NearGround ground = groundUnder(way[i], nearest, *mesh_);
                // A taut strand lies on the head until it leaves for the braid.
                const double most = glm::mix(wanted, kLeaves, ease(0.7, 1.0, t));
                const double gap = std::clamp(ground.gap, wanted, most);
                way[i] = ground.position + gap * ground.outward;
            }
        }
        return way;
    }

private:
    static constexpr std::size_t kPoints = 24;
    static constexpr int kRounds = 3;
    static constexpr double kLeast = 0.002;  // m
    static constexpr double kHeight = 0.006;  // m, of strands that lie on other hair
    static constexpr double kFar = 0.25;  // m
    static constexpr double kLeaves = 0.06;  // m, over the head on the path to the tie

    // Interpolates unit vectors in the plane of both, by even angles.
    static glm::dvec3 turned(const glm::dvec3& from, const glm::dvec3& to, double t) {
        const double angle = std::acos(std::clamp(glm::dot(from, to), -1.0, 1.0));
        if (angle < 1e-3) return glm::normalize(glm::mix(from, to, t));
        return (std::sin((1.0 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle);
    }

    // From a to b round the head's middle by the shortest path. Paths from far away go over the
    // top, because the shortest may lead across the face. They are a Bezier curve of rotations.
    glm::dvec3 arc(const glm::dvec3& a, const glm::dvec3& b, double t) const {
        const double from = glm::length(a);
        const double to = glm::length(b);
        const glm::dvec3 start = a / from;
        const glm::dvec3 end = b / to;
        const double angle = std::acos(std::clamp(glm::dot(start, end), -1.0, 1.0));
        const glm::dvec3 over = glm::normalize(start + end + 1.5 * ease(1.2, 2.6, angle) * over_);
        return std::lerp(from, to, t) * turned(turned(start, over, t), turned(over, end, t), t);
    }

    const Mesh* mesh_;
    std::optional<NearestSurface> surface_;
    glm::dvec3 head_;
    glm::dvec3 over_;  // the direction that paths from far away go over
};

double lengthOf(const std::vector<glm::dvec3>& line) {
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i) length += glm::distance(line[i - 1], line[i]);
    return length;
}

// Puts the points of a strand evenly along the first `length` of a line, which is at least as
// long.
void layAlong(std::span<glm::vec3> points, const std::vector<glm::dvec3>& line, double length) {
    std::size_t piece = 0;
    double before = 0.0;
    double size = glm::distance(line[0], line[1]);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double wanted =
            length * static_cast<double>(i) / static_cast<double>(points.size() - 1);
        while (before + size < wanted && piece + 2 < line.size()) {
            before += size;
            ++piece;
            size = glm::distance(line[piece], line[piece + 1]);
        }
        const double t = size > 0.0 ? std::min((wanted - before) / size, 1.0) : 0.0;
        points[i] = glm::vec3(glm::mix(line[piece], line[piece + 1], t));
    }
}

}  // namespace

Groom braid(Groom groom, const BraidSettings& settings, std::uint32_t seed, const Mesh* mesh) {
    if (settings.pitch == 0.0f || groom.strand_count == 0) return groom;
    const std::uint32_t count = groom.strand_count;
    glm::dvec3 head(0.0);
    for (std::uint32_t i = 0; i < count; ++i)
        head += glm::dvec3(groom.strand(i)[0]) / double(count);
    const BraidAxes axes = axesOf(settings, head);

    // The strands form thirds from one side to the other. The middle third is part 0, which starts
    // in the middle.
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) {
        return glm::dot(glm::dvec3(groom.strand(i)[0]) - head, axes.across);
    });
    std::vector<BraidPlace> places(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        static constexpr std::array<int, 3> kParts{2, 0, 1};
        const std::uint32_t strand = order[i];
        places[strand] = {
            .part = kParts[std::size_t{i} * 3 / count],
            .angle = 2.0 * std::numbers::pi * random01(seed, strand, purpose::braid_angle),
            .radius = std::sqrt(double{random01(seed, strand, purpose::braid_radius)})};
    }

    const WayToTie way_to_tie(mesh, head, 0.8 * axes.out - axes.down);
    const Braid entry(settings, axes, {0.0, 1e9});
    std::vector<std::vector<glm::dvec3>> ways(count);
    std::vector<double> lengths(count);
    std::vector<double> left(count);
    inParallel("leads strands to their braid", count, [&](std::uint32_t i) {
        const auto points = groom.strand(i);
        ways[i] = way_to_tie(glm::dvec3(points[0]), entry.at(places[i], 0.0));
        lengths[i] = AlongStrand(points).length();
        left[i] = std::max(lengths[i] - lengthOf(ways[i]), 0.0);
    });
    const Braid braid(settings, axes, left);
    inParallel("braids strands", count, [&](std::uint32_t i) {
        std::vector<glm::dvec3>& line = ways[i];
        double length = lengthOf(line);
        for (double u = braid.step(); length < lengths[i]; u += braid.step()) {
            const glm::dvec3 next = braid.at(places[i], u);
            length += glm::distance(line.back(), next);
            line.push_back(next);
        }
        glm::vec3* const first = groom.points.data() + std::size_t{i} * groom.vertices_per_strand;
        layAlong(std::span(first, groom.vertices_per_strand), line, lengths[i]);
    });
    return groom;
}

}  // namespace hair::groom
