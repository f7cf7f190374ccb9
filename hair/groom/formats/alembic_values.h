#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/curves.h"
#include "hair/groom/formats/ogawa.h"

// Values of the properties of an Alembic archive: their first samples, checked for their type; the
// transforms of its objects; and its curves between their vertices.
namespace hair::groom {

// ---- Values and transforms ----------------------------------------------------------------------

// The properties of a compound by their names.
struct AlembicCompound {
    std::string path;  // for messages
    std::map<std::string_view, AlembicProperty> properties;

    const AlembicProperty* find(std::string_view name) const;  // null: there is none
};

// Values of a property, or of a property with indices (a compound of `.vals` and `.indices`); at
// least one.
struct AlembicParameter {
    std::string path;
    AlembicProperty property;  // the property with the values
    AlembicElements elements;
    std::vector<std::uint32_t> indices;
    bool has_indices = false;

    std::uint64_t count() const { return has_indices ? indices.size() : elements.count; }

    [[noreturn]] void fail(const std::string& reason) const {
        failIn(elements.start, path, reason);
    }
    // Throws if values are of another type.
    void require(AlembicType type, std::uint8_t extent) const;

    // Returns the values that the indices name; all values if there are no indices.
    template <class Value>
    std::vector<Value> arranged(std::vector<Value> values) const {
        if (!has_indices) return values;
        std::vector<Value> result;
        result.reserve(indices.size());
        for (const std::uint32_t index : indices) result.push_back(values[index]);
        return result;
    }
};

// Functions throw engine::Error "byte N: path: reason". Compounds and properties can be read only
// once.
class AlembicValues {
public:
    // `sample`: AlembicArchive.
    explicit AlembicValues(std::span<const std::byte> bytes, std::uint32_t sample = 0)
        : archive_(bytes, sample) {}

    AlembicArchive& archive() { return archive_; }
    const AlembicArchive& archive() const { return archive_; }
    std::span<const std::byte> bytes() const { return archive_.bytes(); }

    // Returns the compound `name` of an object's properties. Throws if there is none.
    AlembicCompound compoundOf(
        const std::vector<AlembicProperty>& properties, std::string_view name,
        const std::string& path);
    // Returns an object's own properties by their names.
    static AlembicCompound
    compoundOf(const std::vector<AlembicProperty>& properties, const std::string& path);
    // Returns the compound `name` of another; without properties if there is none.
    AlembicCompound compoundIn(const AlembicCompound& outer, std::string_view name);

    // Absent if the property is not there or has no values.
    std::optional<AlembicParameter>
    parameterOf(const AlembicCompound& compound, std::string_view name);

    // Reads vectors of as many float32 as a Value has, which may be NaN or infinite.
    template <class Value>
    std::vector<Value> floatsOf(const AlembicParameter& parameter) const {
        parameter.require(
            AlembicType::float32, static_cast<std::uint8_t>(sizeof(Value) / sizeof(float)));
        return parameter.arranged(stored<Value>(parameter));
    }
    // Reads integers of any type, one to an element, in the range of int32.
    std::vector<std::int32_t> integersOf(const AlembicParameter& parameter) const;
    // Reads numbers of type float64, all finite, exactly as many as expected; indices don't count.
    std::vector<double> doublesOf(const AlembicParameter& parameter, std::size_t expected) const;

    // Returns the values as they are stored; their type must have been checked with require().
    template <class Value>
    std::vector<Value> stored(const AlembicParameter& parameter) const {
        return arrayAt<Value>(bytes(), parameter.elements.start, parameter.elements.count);
    }

private:
    std::int64_t integerAt(std::uint64_t byte, const AlembicParameter& parameter) const;

    AlembicArchive archive_;
};

// An object that moves those below it (AbcGeom_Xform_v3).
struct AlembicTransform {
    AffineSpace space;  // of the objects below
    std::optional<AlembicProperty> numbers;  // of the operations, which may move
};

// Returns the first sample of a transform's operations, from the last to the first, in the space
// above it. Throws engine::Error for an unknown operation, a rotation about no axis and a
// projection.
AlembicTransform alembicTransformOf(
    AlembicValues& values, const AlembicCompound& transform, const AffineSpace& above);

// Returns whether an object's properties hide it: Alembic's ObjectVisibility is 0 if it is hidden
// and 1 if it is visible. Without it, or if it is -1, the object is as the one above it.
bool isHidden(
    AlembicValues& values, const std::vector<AlembicProperty>& properties, const std::string& path,
    bool is_hidden_above);

// ---- Curves between their vertices --------------------------------------------------------------

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
