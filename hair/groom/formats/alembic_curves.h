#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

// A curve with knots.
struct AlembicNurbs {
    std::uint64_t first_knot;  // the number of knots is that of vertices plus the order
    std::uint32_t order;  // degree + 1
    std::uint32_t segments;  // intervals between different successive knots on which the curve is
                             // defined
};

// Evaluates a curve with knots, segment after segment: the weights of its vertices at a place
// (Piegl and Tiller 1997, The NURBS Book, 2.5, algorithm A2.2).
class AlembicKnots {
public:
    static constexpr std::uint32_t kGreatestOrder = 16;

    AlembicKnots(std::span<const float> knots, std::uint32_t order)
        : knots_(knots), order_(order), span_(order - 2) {}

    // Goes to t, from 0 to 1, of a segment. Segments must be asked for in order.
    void go(std::uint32_t segment, double t);

    std::size_t firstVertex() const { return span_ + 1 - order_; }
    std::span<const double> weights() const { return std::span(weights_).first(order_); }

private:
    std::span<const float> knots_;
    std::uint32_t order_;
    std::size_t span_;  // the place is between this knot and the next
    std::uint32_t next_segment_ = 0;
    std::array<double, kGreatestOrder> weights_{};
};

// The number of vertices of each curve, and the places of its points. The points of a linear curve
// are its vertices. A curve of another kind has `pieces` points for each segment, even in t, and
// one more.
class AlembicTopology {
public:
    // Takes nVertices and curveBasisAndType, which may be missing. Throws for closed curves, other
    // bases, invalid knots, and weights that differ.
    AlembicTopology(
        AlembicValues& values, const AlembicCompound& geometry, const AlembicParameter& sizes);

    // Chooses how curves that are not linear are drawn between these vertices. Throws if a curve
    // has too few vertices for its basis. Before this call, only members that follow from the sizes
    // are valid.
    void draw(std::span<const glm::vec3> vertices, const AlembicParameter& sizes);

    bool isLinear() const { return !basis_ && nurbs_.empty(); }
    std::size_t curves() const { return sizes_.size(); }
    std::uint64_t vertices() const { return vertices_; }
    std::uint64_t ends() const;  // ends of segments, of all curves
    std::uint64_t pointsOf(std::size_t curve) const {
        return sizes_[curve] == 0 ? 0 : std::uint64_t{segmentsOf(curve)} * pieces_ + 1;
    }

    // Calls `add` with the value at each point of curves that are not linear, interpolated from
    // `values` of the vertices.
    template <class Value, class Add>
    void alongVertices(std::span<const Value> values, const Add& add) const {
        std::size_t first = 0;
        for (std::size_t i = 0; i < sizes_.size(); ++i) {
            const auto own = values.subspan(first, static_cast<std::size_t>(sizes_[i]));
            first += own.size();
            if (own.size() <= 1) {
                for (const Value& value : own) add(wide(value));
            } else if (nurbs_.empty())
                alongBasis(i, own, add);
            else
                alongKnots(i, own, add);
        }
    }

    // Like alongVertices(), for values at the ends of segments.
    template <class Value, class Add>
    void alongEnds(std::span<const Value> values, const Add& add) const {
        std::size_t first = 0;
        for (std::size_t i = 0; i < sizes_.size(); ++i) {
            if (sizes_[i] == 0) continue;
            if (sizes_[i] == 1) add(wide(values[first]));
            alongSegments(i, [&](std::uint32_t segment, double t) {
                const auto start = wide(values[first + segment]);
                add(start + t * (wide(values[first + segment + 1]) - start));
            });
            first += std::size_t{segmentsOf(i)} + 1;
        }
    }

private:
    static double wide(float value) { return value; }
    static glm::dvec3 wide(const glm::vec3& value) { return value; }

    template <class Value, class Add>
    void alongBasis(std::size_t curve, std::span<const Value> own, const Add& add) const {
        // Extrapolated vertices before the first and after the last continue the curve evenly.
        const auto vertex = [&](std::size_t i) {  // numbered from 1 if the curve is pinned
            if (!is_pinned_) return wide(own[i]);
            if (i == 0) return 2.0 * wide(own[0]) - wide(own[1]);
            if (i > own.size()) return 2.0 * wide(own[i - 2]) - wide(own[i - 3]);
            return wide(own[i - 1]);
        };
        alongSegments(curve, [&](std::uint32_t segment, double t) {
            const std::array<double, 4> weights = weightsAt(*basis_->weights, t);
            const std::size_t start = std::size_t{segment} * basis_->step;
            auto sum = weights[0] * vertex(start);
            for (std::size_t i = 1; i < weights.size(); ++i) sum += weights[i] * vertex(start + i);
            add(sum);
        });
    }

    template <class Value, class Add>
    void alongKnots(std::size_t curve, std::span<const Value> own, const Add& add) const {
        const AlembicNurbs& nurbs = nurbs_[curve];
        const std::span<const float> all(knots_);
        AlembicKnots knots(all.subspan(nurbs.first_knot, own.size() + nurbs.order), nurbs.order);
        alongSegments(curve, [&](std::uint32_t segment, double t) {
            knots.go(segment, t);
            const auto weights = knots.weights();
            auto sum = weights[0] * wide(own[knots.firstVertex()]);
            for (std::size_t i = 1; i < weights.size(); ++i)
                sum += weights[i] * wide(own[knots.firstVertex() + i]);
            add(sum);
        });
    }

    std::uint32_t segmentsOf(std::size_t curve) const {
        if (!nurbs_.empty()) return nurbs_[curve].segments;
        const auto size = static_cast<std::uint32_t>(sizes_[curve]);
        if (size <= 1) return 0;
        return !basis_ || is_pinned_ ? size - 1 : (size - 4) / basis_->step + 1;
    }

    // Calls `at` with the segment and t of each point of a curve with segments.
    template <class At>
    void alongSegments(std::size_t curve, const At& at) const {
        const std::uint32_t segments = segmentsOf(curve);
        for (std::uint32_t segment = 0; segment < segments; ++segment)
            for (std::uint32_t k = 0; k < pieces_; ++k) at(segment, double(k) / pieces_);
        if (segments > 0) at(segments - 1, 1.0);
    }

    bool hasDoubledEnds(std::span<const glm::vec3> vertices) const;
    void readKnots(
        const AlembicValues& values, const AlembicParameter& knots,
        const std::optional<AlembicParameter>& orders);

    std::vector<std::int32_t> sizes_;  // [curve], vertices; 0 and 1 make no segment
    const AlembicBasis* basis_ = nullptr;  // null: linear, or with knots
    bool is_pinned_ = false;  // cubic, and runs through all of its vertices
    std::vector<AlembicNurbs> nurbs_;  // [curve]; empty: without knots
    std::vector<float> knots_;  // of all curves
    std::uint64_t vertices_ = 0;
    std::uint32_t pieces_ = 1;
};

}  // namespace hair::groom
