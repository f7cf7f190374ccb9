#include "hair/groom/guides/bind_strands.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <span>

#include <glm/geometric.hpp>

#include "hair/groom/guides/nearest_mean.h"
#include "hair/groom/guides/root_tree.h"

namespace hair {
namespace {

// How far a strand's root is from another's, and then its other vertices once the roots are put
// together. Their squares add up to that of the roots' distance and the mean of the others': as
// when guides are chosen, h between roots weighs as h between shapes.
void differences(
    std::span<const glm::vec3> strand, std::span<const glm::vec3> other,
    std::span<glm::dvec3> apart) {
    const double scale = 1.0 / std::sqrt(static_cast<double>(strand.size() - 1));
    apart[0] = glm::dvec3(strand[0]) - glm::dvec3(other[0]);
    for (std::size_t k = 1; k < strand.size(); ++k)
        apart[k] = scale * (glm::dvec3(strand[k]) - glm::dvec3(other[k]) - apart[0]);
}

double product(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    return std::transform_reduce(
        a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
        [](const glm::dvec3& p, const glm::dvec3& q) { return glm::dot(p, q); });
}

// The binding's weighted mean of a vertex of the guides; `strandOf` gives a guide's points.
template <class StrandOf>
glm::dvec3 weightedMean(const StrandBinding& binding, std::size_t vertex, StrandOf&& strandOf) {
    glm::dvec3 mean(0.0);
    for (int i = 0; i < 3; ++i)
        mean += double{binding.weights[i]} *
                glm::dvec3(strandOf(binding.guides[static_cast<std::size_t>(i)])[vertex]);
    return mean;
}

// Binds strands to the guides of one groom, one at a time, with room that it keeps.
class Binder {
public:
    Binder(const Groom& dense, const std::vector<std::uint32_t>& guides)
        : dense_(dense), guides_(guides), tree_(rootsOf(dense, guides)),
          apart_(kMostCandidates * dense.vertices_per_strand) {}

    StrandBinding operator()(std::uint32_t strand) {
        std::array<std::uint32_t, kMostCandidates> near{};
        const auto points = dense_.strand(strand);
        Products products{.count = tree_.find(points[0], near)};
        for (std::size_t i = 0; i < products.count; ++i) {
            differences(guide(near[i]), points, apart(i));
            for (std::size_t j = 0; j <= i; ++j)
                products.of[i][j] = products.of[j][i] = product(apart(i), apart(j));
        }
        const Mean mean = nearestMean(products);
        StrandBinding binding;
        for (std::size_t i = 0; i < 3; ++i) binding.guides[i] = near[mean.members[i]];
        binding.weights.y = static_cast<float>(mean.weights[1]);
        binding.weights.z = static_cast<float>(mean.weights[2]);
        binding.weights.x = 1.0f - binding.weights.y - binding.weights.z;
        binding.offset =
            glm::vec3(glm::dvec3(points[0]) - weightedMean(binding, 0, [this](std::uint32_t i) {
                          return guide(i);
                      }));
        return binding;
    }

private:
    static std::vector<glm::vec3>
    rootsOf(const Groom& dense, const std::vector<std::uint32_t>& guides) {
        std::vector<glm::vec3> roots;
        roots.reserve(guides.size());
        for (const std::uint32_t guide : guides) roots.push_back(dense.strand(guide)[0]);
        return roots;
    }

    std::span<const glm::vec3> guide(std::uint32_t index) const {
        return dense_.strand(guides_[index]);
    }

    std::span<glm::dvec3> apart(std::size_t candidate) {
        const std::size_t size = dense_.vertices_per_strand;
        return std::span(apart_).subspan(candidate * size, size);
    }

    const Groom& dense_;
    const std::vector<std::uint32_t>& guides_;
    RootTree tree_;
    std::vector<glm::dvec3> apart_;  // [candidate][vertex]
};

double lengthOf(std::span<const glm::vec3> strand) {
    double length = 0.0;
    for (std::size_t k = 1; k < strand.size(); ++k)
        length += glm::distance(glm::dvec3(strand[k - 1]), glm::dvec3(strand[k]));
    return length;
}

}  // namespace

std::vector<StrandBinding>
bindStrands(const Groom& dense, const std::vector<std::uint32_t>& guides) {
    assert(!guides.empty());
    std::optional<Binder> bind;
    if (guides.size() < dense.strand_count) bind.emplace(dense, guides);
    std::vector<StrandBinding> bindings(dense.strand_count);
    std::uint32_t next = 0;
    for (std::uint32_t strand = 0; strand < dense.strand_count; ++strand) {
        if (next < guides.size() && guides[next] == strand) {
            bindings[strand].guides = {next, next, next};
            ++next;
        } else {
            bindings[strand] = (*bind)(strand);
        }
    }
    return bindings;
}

ReconstructionError reconstructionError(
    const Groom& dense, const Groom& guides, const std::vector<StrandBinding>& bindings) {
    assert(bindings.size() == dense.strand_count && dense.strand_count > 0);
    assert(guides.vertices_per_strand == dense.vertices_per_strand);
    const double vertices = dense.vertices_per_strand;
    ReconstructionError error;
    double lengths = 0.0;
    std::vector<double> means;
    means.reserve(dense.strand_count);
    for (std::uint32_t i = 0; i < dense.strand_count; ++i) {
        const auto strand = dense.strand(i);
        double sum = 0.0;
        for (std::size_t k = 0; k < strand.size(); ++k) {
            const glm::dvec3 given =
                glm::dvec3(bindings[i].offset) +
                weightedMean(bindings[i], k, [&](std::uint32_t g) { return guides.strand(g); });
            const double distance = glm::distance(given, glm::dvec3(strand[k]));
            sum += distance;
            error.rms += distance * distance;
            error.maximum = std::max(error.maximum, distance);
        }
        lengths += lengthOf(strand);
        means.push_back(sum / vertices);
        error.mean += sum / vertices;
    }
    const double strands = dense.strand_count;
    error.mean /= strands;
    error.rms = std::sqrt(error.rms / (strands * vertices));
    error.relative = lengths > 0.0 ? error.mean * strands / lengths : 0.0;
    // The least number that 95 % of the strands don't exceed.
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * strands)) - 1;
    std::ranges::nth_element(means, means.begin() + rank);
    error.percentile95 = means[static_cast<std::size_t>(rank)];
    return error;
}

}  // namespace hair
