#pragma once

#include <array>
#include <cstddef>

namespace hair {

inline constexpr std::size_t kMostCandidates = 8;

// The inner products of the vectors from one point to several others, in any number of dimensions.
struct Products {
    std::size_t count = 0;  // at least 1
    std::array<std::array<double, kMostCandidates>, kMostCandidates> of{};
};

// A weighted mean of three of those points, heaviest first; where fewer have a weight, the first
// stands in for the rest.
struct Mean {
    std::array<std::size_t, 3> members{};
    std::array<double, 3> weights{1.0, 0.0, 0.0};  // sum 1, none negative
};

// The mean of at most three points that comes nearest to the one point. Of means that come about as
// near it takes that of points which are near themselves: in a plane, where several triangles hold
// the point, the Delaunay triangle.
Mean nearestMean(const Products& products);

}  // namespace hair
