#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/formats/binary_file.h"
#include "hair/groom/formats/curves.h"
#include "hair/groom/formats/ogawa.h"

// Values of the properties of an Alembic archive: their first samples, checked for their type; and
// the transforms of its objects.
namespace hair::groom {

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

}  // namespace hair::groom
