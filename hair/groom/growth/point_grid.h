#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hair {

// Points sorted into cubes as wide as a radius. A point is known by its place; places that are near
// in space are near in memory.
class PointGrid {
public:
    PointGrid(std::span<const glm::vec3> points, double radius);

    std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }
    std::uint32_t source(std::uint32_t place) const { return sources_[place]; }
    // A number of the point that depends on its cube and the other points alone.
    std::uint32_t rank(std::uint32_t place) const { return ranks_[place]; }

    // Calls visit(place, distance) for every other point that is left and closer than the radius.
    template <class Visit>
    void forEachNear(std::uint32_t place, Visit&& visit) const {
        const glm::vec3 point = positions_[place];
        Neighbours neighbours;
        for (const NearCube& cube : std::span(neighbours.begin(), findNear(point, neighbours))) {
            for (std::uint32_t i = cube.bucket.first; i < cube.bucket.end; ++i) {
                const Point& other = points_[i];
                const glm::vec3 gap = other.position - point;
                // Most end here, without a root. Cubes can share a bucket.
                if (glm::dot(gap, gap) > square_limit_ || other.key != cube.key) continue;
                const double distance = glm::distance(other.position, point);
                if (distance < radius_ && other.place != place) visit(other.place, distance);
            }
        }
    }

    // Near points don't see it any more.
    void erase(std::uint32_t place);

private:
    struct Cube {
        int x, y, z;
    };
    struct Bucket {
        std::uint32_t first = 0;
        std::uint32_t end = 0;  // after its last point that is left
    };
    struct Point {
        glm::vec3 position;
        std::uint32_t place;
        std::uint32_t key;  // of its cube
    };
    struct NearCube {
        Bucket bucket;
        std::uint32_t key;
    };
    using Neighbours = std::array<NearCube, 27>;

    // Fills in the cubes round a point that may have points, and returns how many.
    std::size_t findNear(const glm::vec3& point, Neighbours& neighbours) const;
    Cube cube(const glm::vec3& point) const;
    std::size_t number(const Cube& cube) const;  // of its bucket
    static std::uint32_t key(const Cube& cube);

    double radius_;
    float square_limit_;  // a little more than the radius squared
    std::vector<Bucket> buckets_;
    std::vector<Point> points_;  // by bucket; those that are left first
    std::vector<std::uint32_t> where_;  // [place], index into points_
    std::vector<glm::vec3> positions_;  // [place]
    std::vector<std::uint32_t> ranks_;  // [place]
    std::vector<std::uint32_t> sources_;  // [place], index of the point as given
};

}  // namespace hair
