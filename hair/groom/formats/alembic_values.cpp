#include "hair/groom/formats/alembic_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hair/groom/formats/text.h"

namespace hair::groom {
namespace {

std::string typeText(AlembicType type, std::uint8_t extent) {
    return std::to_string(extent) + " \xc3\x97 " + std::string(nameOf(type));
}

AlembicCompound
compoundFrom(const std::vector<AlembicProperty>& properties, const std::string& path) {
    AlembicCompound compound{.path = path, .properties = {}};
    for (const AlembicProperty& property : properties)
        if (!compound.properties.emplace(property.name, property).second)
            failIn(property.header, path, inQuotes(property.name) + " appears twice");
    return compound;
}

}  // namespace

const AlembicProperty* AlembicCompound::find(std::string_view name) const {
    const auto at = properties.find(name);
    return at == properties.end() ? nullptr : &at->second;
}

void AlembicParameter::require(AlembicType type, std::uint8_t extent) const {
    if (property.isOf(type, extent)) return;
    fail(
        "values of " + typeText(property.type, property.extent) + ", expected " +
        typeText(type, extent));
}

AlembicCompound AlembicValues::compoundOf(
    const std::vector<AlembicProperty>& properties, std::string_view name,
    const std::string& path) {
    const auto at = std::ranges::find(properties, name, &AlembicProperty::name);
    if (at == properties.end() || at->kind != AlembicKind::compound)
        failIn(
            properties.empty() ? 0 : properties.front().header, path,
            "there is no " + inQuotes(name));
    const std::string own = path + '/' + std::string(name);
    return compoundFrom(archive_.propertiesOf(*at, own), own);
}

AlembicCompound
AlembicValues::compoundOf(const std::vector<AlembicProperty>& properties, const std::string& path) {
    return compoundFrom(properties, path);
}

AlembicCompound AlembicValues::compoundIn(const AlembicCompound& outer, std::string_view name) {
    const AlembicProperty* const property = outer.find(name);
    const std::string own = outer.path + '/' + std::string(name);
    if (!property || property->kind != AlembicKind::compound)
        return {.path = own, .properties = {}};
    return compoundFrom(archive_.propertiesOf(*property, own), own);
}

std::optional<AlembicParameter>
AlembicValues::parameterOf(const AlembicCompound& compound, std::string_view name) {
    const AlembicProperty* const property = compound.find(name);
    if (!property) return {};
    AlembicParameter parameter{
        .path = compound.path + '/' + std::string(name), .property = *property};
    std::uint64_t indices_start = 0;
    if (property->kind == AlembicKind::compound) {
        const AlembicCompound parts =
            compoundFrom(archive_.propertiesOf(*property, parameter.path), parameter.path);
        const AlembicProperty* const values = parts.find(".vals");
        if (!values || values->kind == AlembicKind::compound)
            failIn(property->header, parameter.path, "a compound without values");
        parameter.property = *values;
        if (const AlembicProperty* const indices = parts.find(".indices")) {
            const std::string path = parameter.path + "/.indices";
            if (!indices->isOf(AlembicType::uint32, 1))
                failIn(indices->header, path, "indices are of uint32");
            if (const auto elements = archive_.sampleOf(*indices, path)) {
                parameter.has_indices = true;
                indices_start = elements->start;
                parameter.indices =
                    arrayAt<std::uint32_t>(bytes(), elements->start, elements->count);
            }
        }
        parameter.path += "/.vals";
    }
    const auto elements = archive_.sampleOf(parameter.property, parameter.path);
    if (!elements || elements->count == 0) return {};
    parameter.elements = *elements;
    for (std::size_t i = 0; i < parameter.indices.size(); ++i)
        if (parameter.indices[i] >= elements->count)
            failIn(
                indices_start + i * sizeof(std::uint32_t), parameter.path,
                "index " + std::to_string(parameter.indices[i]) + " of " +
                    std::to_string(elements->count) + " values");
    if (parameter.count() == 0) return {};
    return parameter;
}

std::vector<std::int32_t> AlembicValues::integersOf(const AlembicParameter& parameter) const {
    if (parameter.property.extent != 1) parameter.fail("one integer is expected of each");
    std::vector<std::int32_t> values;
    values.reserve(parameter.elements.count);
    const std::size_t size = sizeOf(parameter.property.type);
    for (std::uint64_t i = 0; i < parameter.elements.count; ++i) {
        const std::uint64_t byte = parameter.elements.start + i * size;
        const std::int64_t value = integerAt(byte, parameter);
        if (value < std::numeric_limits<std::int32_t>::min() ||
            value > std::numeric_limits<std::int32_t>::max())
            failIn(byte, parameter.path, std::to_string(value) + " is not an int32");
        values.push_back(static_cast<std::int32_t>(value));
    }
    return parameter.arranged(std::move(values));
}

std::int64_t AlembicValues::integerAt(std::uint64_t byte, const AlembicParameter& parameter) const {
    switch (parameter.property.type) {
    case AlembicType::boolean:
    case AlembicType::uint8:
        return valueAt<std::uint8_t>(bytes(), byte);
    case AlembicType::int8:
        return valueAt<std::int8_t>(bytes(), byte);
    case AlembicType::uint16:
        return valueAt<std::uint16_t>(bytes(), byte);
    case AlembicType::int16:
        return valueAt<std::int16_t>(bytes(), byte);
    case AlembicType::uint32:
        return valueAt<std::uint32_t>(bytes(), byte);
    case AlembicType::int32:
        return valueAt<std::int32_t>(bytes(), byte);
    case AlembicType::uint64:  // values from 2^63 on become negative, and none are in range
    case AlembicType::int64:
        return valueAt<std::int64_t>(bytes(), byte);
    default:
        parameter.fail("values of " + typeText(parameter.property.type, 1) + ", expected integers");
    }
}

std::vector<double>
AlembicValues::doublesOf(const AlembicParameter& parameter, std::size_t expected) const {
    const std::uint64_t count = parameter.elements.count * parameter.property.extent;
    if (parameter.property.type != AlembicType::float64 || count != expected)
        parameter.fail(
            std::to_string(count) + " numbers of " + std::string(nameOf(parameter.property.type)) +
            ", expected " + std::to_string(expected) + " doubles");
    auto numbers = arrayAt<double>(bytes(), parameter.elements.start, count);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!std::isfinite(numbers[i]))
            failIn(
                parameter.elements.start + i * sizeof(double), parameter.path,
                "number " + std::to_string(i) + " is not finite");
    return numbers;
}

}  // namespace hair::groom
