#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/formats/alembic_values.h"
#include "hair/groom/formats/curves.h"

// The curves of an Alembic object between their vertices.
namespace hair::groom {

struct AlembicBasis {
    std::string_view name;
    const CurveBasis* weights;  // null: not read
    std::uint32_t step;  // vertices from a segment to the next
};

// How many vertices each curve has, and where its points are: a linear curve's are its vertices, a
// cubic one's are even in t, `pieces` and one more for each segment.
class AlembicTopology {
public:
    // Of nVertices and curveBasisAndType, which may be missing. Throws for curves that are closed
    // or neither linear nor cubic, for other bases, knots, orders, and weights that differ.
    AlembicTopology(
        AlembicValues& values, const AlembicCompound& geometry, const AlembicParameter& sizes);

    // Chooses how cubic curves of these vertices are drawn. Throws where a curve has too few for
    // its basis. Before it, only what follows from the sizes is there.
    void draw(std::span<const glm::vec3> vertices, const AlembicParameter& sizes);

    bool isCubic() const { return basis_ != nullptr; }
    std::span<const std::int32_t> sizes() const { return sizes_; }  // [curve], at least 1
    std::uint64_t vertices() const { return vertices_; }
    std::uint64_t ends() const;  // of segments, of all curves
    std::uint64_t pointsOf(std::int32_t size) const {
        return std::uint64_t{segmentsOf(size)} * pieces_ + 1;
    }

    // Calls `add` with the value at each point, as `values` of the vertices have it.
    template <class Value, class Add>
    void alongVertices(std::span<const Value> values, const Add& add) const {
        std::size_t first = 0;
        for (const std::int32_t size : sizes_) {
            const auto own = values.subspan(first, static_cast<std::size_t>(size));
            first += own.size();
            // A vertex before the first and one after the last continue the curve evenly.
            const auto vertex = [&](std::size_t i) {  // from 1 where it is pinned
                if (!is_pinned_) return wide(own[i]);
                if (i == 0) return 2.0 * wide(own[0]) - wide(own[1]);
                if (i > own.size()) return 2.0 * wide(own[i - 2]) - wide(own[i - 3]);
                return wide(own[i - 1]);
            };
            alongSegments(size, [&](std::uint32_t segment, double t) {
                const std::array<double, 4> weights = weightsAt(*basis_->weights, t);
                const std::size_t start = std::size_t{segment} * basis_->step;
                auto sum = weights[0] * vertex(start);
                for (std::size_t i = 1; i < weights.size(); ++i)
                    sum += weights[i] * vertex(start + i);
                add(sum);
            });
        }
    }

    // As alongVertices(), of values at the ends of segments.
    template <class Value, class Add>
    void alongEnds(std::span<const Value> values, const Add& add) const {
        std::size_t first = 0;
        for (const std::int32_t size : sizes_) {
            alongSegments(size, [&](std::uint32_t segment, double t) {
                const auto start = wide(values[first + segment]);
                add(start + t * (wide(values[first + segment + 1]) - start));
            });
            first += std::size_t{segmentsOf(size)} + 1;
        }
    }

private:
    static double wide(float value) { return value; }
    static glm::dvec3 wide(const glm::vec3& value) { return value; }

    std::uint32_t segmentsOf(std::int32_t size) const {
        const auto count = static_cast<std::uint32_t>(size);
        return !basis_ || is_pinned_ ? count - 1 : (count - 4) / basis_->step + 1;
    }

    // Calls `at` with the segment and t of each point of a curve that has segments.
    template <class At>
    void alongSegments(std::int32_t size, const At& at) const {
        const std::uint32_t segments = segmentsOf(size);
        for (std::uint32_t segment = 0; segment < segments; ++segment)
            for (std::uint32_t k = 0; k < pieces_; ++k) at(segment, double(k) / pieces_);
        at(segments - 1, 1.0);
    }

    bool hasDoubledEnds(std::span<const glm::vec3> vertices) const;

    std::vector<std::int32_t> sizes_;
    const AlembicBasis* basis_ = nullptr;  // null: linear
    bool is_pinned_ = false;  // cubic, and runs through all of its vertices
    std::uint64_t vertices_ = 0;
    std::uint32_t pieces_ = 1;
};

}  // namespace hair::groom
