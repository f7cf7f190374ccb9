#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace hair {

// Finds those of many points that are nearest to a place. Bentley 1975, Multidimensional binary
// search trees used for associative searching.
class RootTree {
public:
    explicit RootTree(std::span<const glm::vec3> points);

    // Fills `nearest` with the indices of the nearest points, nearest first, of equally far ones
    // the lower index first. Returns how many there are: fewer only where there are fewer points.
    std::size_t find(const glm::vec3& place, std::span<std::uint32_t> nearest) const;

private:
    struct Node {
        glm::vec3 point;
        std::uint32_t source;  // the point's index
        int axis;  // along which the points before and after it are apart
    };
    std::vector<Node> nodes_;  // the middle one of each range splits it
};

}  // namespace hair
