#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"

// The strands between guides: each bound to three of them.
namespace hair::groom {

// Binds every strand of a dense groom to three guides with near roots and a mean like the strand.
// `guides` are the dense strands, in ascending order, that became the guides 0, 1, …; each of them
// is bound to itself alone. With fewer than three guides, some of the three are the same.
std::vector<StrandBinding>
bindStrands(const Groom& dense, const std::vector<std::uint32_t>& guides);

// The distances of the strands that guides and bindings give from those of the dense groom, vertex
// against vertex.
struct ReconstructionError {
    double mean = 0.0;      // m
    double rms = 0.0;       // m
    double percentile95 = 0.0;  // m, of the strands' own means
    double maximum = 0.0;   // m
    double relative = 0.0;  // mean / mean strand length
};

ReconstructionError reconstructionError(
    const Groom& dense, const Groom& guides, const std::vector<StrandBinding>& bindings);

inline constexpr std::size_t kMostCandidates = 8;

// The inner products of the vectors from one point to several others, in any number of dimensions.
struct GramMatrix {
    std::size_t count = 0;  // at least 1
    std::array<std::array<double, kMostCandidates>, kMostCandidates> of{};
};

// A weighted mean of three points of a GramMatrix, heaviest first. If fewer have a weight, the
// first stands in for the rest.
struct Mean {
    std::array<std::size_t, 3> members{};
    std::array<double, 3> weights{1.0, 0.0, 0.0};  // sum 1, none negative
};

// Returns the mean of at most three points that comes nearest to the one point. If several are
// about as near, it takes the mean of points that are near themselves. In a plane where several
// triangles hold the point, this is the Delaunay triangle.
Mean nearestMean(const GramMatrix& gram);

// Finds the points nearest to a place. Bentley 1975, Multidimensional binary search trees used for
// associative searching.
class RootKdTree {
public:
    explicit RootKdTree(std::span<const glm::vec3> points);

    // Fills `nearest` with the indices of the nearest points, nearest first; of equally far
    // points, the lower index comes first. Returns their number, which is smaller only if there
    // are fewer points.
    std::size_t find(const glm::vec3& place, std::span<std::uint32_t> nearest) const;

private:
    struct Node {
        glm::vec3 point;
        std::uint32_t source;  // the point's index
        int axis;  // along which the node separates the points before and after it
    };
    std::vector<Node> nodes_;  // the middle node of each range splits it
};

}  // namespace hair::groom
