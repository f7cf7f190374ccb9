#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/growth/parting.h"
#include "hair/groom/growth/root_density.h"
#include "hair/groom/growth/scalp.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"
#include "hair/random.h"

// The roots of a scalp's guides, spread evenly, and the triangles between them.
namespace hair::groom {

// ---- Even points on a surface -------------------------------------------------------------------

// A priority queue of entries with weights that only fall. Entries wait unsorted in bins by
// weight; only the highest bin is a heap.
class BucketQueue {
public:
    struct Entry {
        double weight;  // at least 0
        std::uint32_t tie;  // decides between equal weights
        std::uint32_t item;
        auto operator<=>(const Entry&) const = default;
    };

    explicit BucketQueue(std::vector<Entry> entries) : bins_(entries.size() / 256 + 1) {
        double most = 0.0;
        for (const Entry& entry : entries) most = std::max(most, entry.weight);
        if (most > 0.0) per_weight_ = static_cast<double>(bins_.size() - 1) / most;
        for (const Entry& entry : entries) bins_[bin(entry.weight)].push_back(entry);
        open_ = bins_.size() - 1;
        std::ranges::make_heap(bins_[open_]);
    }

    // Removes and returns the item with the greatest weight; the queue must not be empty.
    // weightOf(item) is the current weight of an item.
    template <class WeightOf>
    std::uint32_t pop(WeightOf&& weightOf) {
        while (true) {
            std::vector<Entry>& heap = bins_[open_];
            if (heap.empty()) {
                openNext(weightOf);
                continue;
            }
            std::ranges::pop_heap(heap);
            Entry entry = heap.back();
            heap.pop_back();
            const double weight = weightOf(entry.item);
            if (weight == entry.weight) return entry.item;
            entry.weight = weight;
            bins_[bin(weight)].push_back(entry);
            if (bin(weight) == open_) std::ranges::push_heap(heap);
        }
    }

private:
    std::size_t bin(double weight) const {
        return static_cast<std::size_t>(std::max(weight, 0.0) * per_weight_);
    }

    template <class WeightOf>
    void openNext(WeightOf&& weightOf) {
        --open_;
        std::vector<Entry> entries = std::exchange(bins_[open_], {});
        for (Entry& entry : entries) {
            entry.weight = weightOf(entry.item);
            bins_[bin(entry.weight)].push_back(entry);
        }
        std::ranges::make_heap(bins_[open_]);
    }

    std::vector<std::vector<Entry>> bins_;
    double per_weight_ = 0.0;
    std::size_t open_ = 0;
};

// Points sorted into cells as wide as a radius. A point is known by its place; places that are
// near in space are near in memory.
class HashGrid {
public:
    HashGrid(std::span<const glm::vec3> points, double radius);

    std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }
    std::uint32_t source(std::uint32_t place) const { return sources_[place]; }
    // A number of the point that depends only on its cell and the other points.
    std::uint32_t rank(std::uint32_t place) const { return ranks_[place]; }

    // Calls visit(place, distance) for every other point that is left and closer than the radius.
    template <class Visit>
    void forEachNear(std::uint32_t place, Visit&& visit) const {
        const glm::vec3 point = positions_[place];
        Neighbours neighbours;
        for (const NearCell& cell : std::span(neighbours.begin(), findNear(point, neighbours))) {
            for (std::uint32_t i = cell.bucket.first; i < cell.bucket.end; ++i) {
                const Point& other = points_[i];
                const glm::vec3 gap = other.position - point;
                // Most points are left out here, without a square root. Cells can share a bucket.
                if (glm::dot(gap, gap) > square_limit_ || other.key != cell.key) continue;
                const double distance = glm::distance(other.position, point);
                if (distance < radius_ && other.place != place) visit(other.place, distance);
            }
        }
    }

    // Removes a point; forEachNear() no longer visits it.
    void erase(std::uint32_t place);

private:
    struct Cell {
        int x, y, z;
    };
    struct Bucket {
        std::uint32_t first = 0;
        std::uint32_t end = 0;  // after its last point that is left
    };
    struct Point {
        glm::vec3 position;
        std::uint32_t place;
        std::uint32_t key;  // of its cell
    };
    struct NearCell {
        Bucket bucket;
        std::uint32_t key;
    };
    using Neighbours = std::array<NearCell, 27>;

    // Fills in the cells round a point that may have points. Returns their number.
    std::size_t findNear(const glm::vec3& point, Neighbours& neighbours) const;
    Cell cell(const glm::vec3& point) const;
    std::size_t number(const Cell& cell) const;  // of its bucket
    static std::uint32_t key(const Cell& cell);

    double radius_;
    float square_limit_;  // a little more than the radius squared
    std::vector<Bucket> buckets_;
    std::vector<Point> points_;  // by bucket; those that are left first
    std::vector<std::uint32_t> where_;  // [place], index into points_
    std::vector<glm::vec3> positions_;  // [place]
    std::vector<std::uint32_t> ranks_;  // [place]
    std::vector<std::uint32_t> sources_;  // [place], index of the point as given
};

// Picks `count` of the candidates, far from each other and from the fixed points. The candidates
// are uniform over a surface of `area` m^2 and the fixed points lie on its boundary. Returns
// indices in ascending order. Time and memory grow with the number of candidates.
// Yuksel 2015, Sample elimination for generating Poisson disk sample sets.
std::vector<std::uint32_t> eliminateSamples(
    std::span<const glm::vec3> candidates, std::span<const glm::vec3> fixed, std::uint32_t count,
    double area);

// ---- Roots --------------------------------------------------------------------------------------

struct RootOptions {
    std::uint32_t guides = 0;
    std::uint32_t seed = 0;
    RootPlacement placement = RootPlacement::poisson_disc;
    const Texture* mask = nullptr;  // null: the same everywhere
    const PartingLine* parting = nullptr;  // null: none
    bool dense = false;  // many roots, without rows or triangles
};

struct Roots {
    std::vector<SurfacePoint> points;  // the hairline's first, in its order
    std::uint32_t boundary_count = 0;
    // Counter-clockwise seen from outside. One root has {0, 0, 0}, two have {0, 1, 1}.
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Puts `guides` >= 1 roots on the scalp. On a disc without a mask that can be flattened, some of
// the poisson_disc roots lie evenly along its hairline, and the triangles are Delaunay on the
// sphere of directions. On every other scalp, roots lie in proportion to the mask, with the
// triangles of surfaceTriangles(). With a parting, two rows of roots run along it, and no triangle
// reaches over it; this needs three more guides than both rows have. Throws engine::Error if the
// mask leaves no place for the roots.
Roots placeRoots(const Scalp& scalp, const NearestSurface& surface, const RootOptions& options);

// Number of `guides` roots that lie on the hairline. The thesis's 86 guides with 136 root
// triangles have 34 there (Euler: 2 * 86 - 2 - 34 = 136). The number is proportional to the square
// root of `guides`, as an edge's length is to the square root of an area.
std::uint32_t boundaryRootCount(std::uint32_t guides);

// Returns lengths along a hairline of `total` m at which `count` roots are evenly spaced, the first
// at 0. With up to two cuts, they go from `gap` after a cut to `gap` before the next, with a root
// at either end.
std::vector<double>
hairlineLengths(double total, std::uint32_t count, std::vector<double> cuts, double gap);

}  // namespace hair::groom
