#include "hair/groom/formats/alembic_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

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

namespace {

// ---- Transforms ---------------------------------------------------------------------------------

// Count of numbers of an operation, by Alembic's XformOperationType: scale, translation, rotation
// about an axis, matrix, rotations about x, y and z.
constexpr std::array<std::size_t, 7> kOperationNumbers{3, 3, 4, 16, 1, 1, 1};

// Returns an operation as an affine map, with numbers in the order of kOperationNumbers.
AffineSpace
operationOf(std::size_t type, std::span<const double> numbers, const AlembicParameter& where) {
    AffineSpace space;
    const auto rotate = [&](const glm::dvec3& axis, double degrees) {
        const double length = std::sqrt(glm::dot(axis, axis));
        if (length == 0.0 && degrees != 0.0) where.fail("a rotation about no axis");
        if (length == 0.0) return;
        const double angle = degrees * (std::numbers::pi / 180.0);
        const glm::dvec3 n = axis / length;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        // Rodrigues: I cos + (1 - cos) n nT + sin [n]x; [column][row].
        for (int column = 0; column < 3; ++column) {
            glm::dvec3 unit(0.0);
            unit[column] = 1.0;
            space.linear[column] = c * unit + (1.0 - c) * n[column] * n + s * glm::cross(n, unit);
        }
    };
    switch (type) {
    case 0:
        for (int i = 0; i < 3; ++i) space.linear[i][i] = numbers[static_cast<std::size_t>(i)];
        break;
    case 1:
        space.translation = {numbers[0], numbers[1], numbers[2]};
        break;
    case 2:
        rotate({numbers[0], numbers[1], numbers[2]}, numbers[3]);
        break;
    case 3:
        // Rows of the matrix for row vectors are columns of that for column vectors.
        for (int i = 0; i < 3; ++i) {
            const auto row = numbers.subspan(4 * static_cast<std::size_t>(i), 4);
            space.linear[i] = {row[0], row[1], row[2]};
            if (row[3] != 0.0) where.fail("a projection");
        }
        space.translation = {numbers[12], numbers[13], numbers[14]};
        if (numbers[15] != 1.0) where.fail("a projection");
        break;
    default: {
        glm::dvec3 axis(0.0);
        axis[static_cast<int>(type) - 4] = 1.0;
        rotate(axis, numbers[0]);
    }
    }
    return space;
}

}  // namespace

AlembicTransform alembicTransformOf(
    AlembicValues& values, const AlembicCompound& transform, const AffineSpace& above) {
    AlembicTransform result{.space = above, .numbers = {}};
    if (const auto inherits = values.parameterOf(transform, ".inherits")) {
        inherits->require(AlembicType::boolean, 1);
        if (values.stored<std::uint8_t>(*inherits).front() == 0) result.space = {};
    }
    const auto operations = values.parameterOf(transform, ".ops");
    const auto numbers = values.parameterOf(transform, ".vals");
    if (!operations) return result;
    operations->require(AlembicType::uint8, operations->property.extent);
    if (!numbers) operations->fail("operations without numbers");
    const auto codes = arrayAt<std::uint8_t>(
        values.bytes(), operations->elements.start,
        operations->elements.count * operations->property.extent);
    std::size_t expected = 0;
    for (const std::uint8_t code : codes) {
        const std::size_t type = code >> 4;
        if (type >= kOperationNumbers.size())
            operations->fail("the unknown operation " + std::to_string(type));
        expected += kOperationNumbers[type];
    }
    result.numbers = numbers->property;
    const std::vector<double> all = values.doublesOf(*numbers, expected);
    std::span<const double> rest(all);
    for (const std::uint8_t code : codes) {
        const std::size_t type = code >> 4;
        result.space =
            result.space.of(operationOf(type, rest.first(kOperationNumbers[type]), *numbers));
        rest = rest.subspan(kOperationNumbers[type]);
    }
    return result;
}

bool isHidden(
    AlembicValues& values, const std::vector<AlembicProperty>& properties, const std::string& path,
    bool is_hidden_above) {
    const auto property = std::ranges::find(properties, "visible", &AlembicProperty::name);
    if (property == properties.end()) return is_hidden_above;
    const auto visible =
        values.parameterOf({.path = path, .properties = {{"visible", *property}}}, "visible");
    if (!visible) return is_hidden_above;
    const std::int32_t code = values.integersOf(*visible).front();
    return code == -1 ? is_hidden_above : code == 0;
}

// ---- Curves -------------------------------------------------------------------------------------

namespace {

using namespace std::string_view_literals;

// In the order of Alembic's BasisType.
constexpr std::array kAlembicBases{
    AlembicBasis{"no basis", nullptr, 1},        AlembicBasis{"B\xc3\xa9zier", &kBezierBasis, 3},
    AlembicBasis{"B-spline", &kBsplineBasis, 1}, AlembicBasis{"Catmull-Rom", &kCatmullRomBasis, 1},
    AlembicBasis{"Hermite", nullptr, 2},         AlembicBasis{"power", nullptr, 4}};

// Alembic's CurveType.
constexpr std::uint8_t kCubicCurves = 0;
constexpr std::uint8_t kLinearCurves = 1;
constexpr std::uint8_t kCurvesOfOrders = 2;

constexpr auto kExportLinear = ": export them as linear curves (polylines)"sv;

}  // namespace

AlembicTopology::AlembicTopology(
    AlembicValues& values, const AlembicCompound& geometry, const AlembicParameter& sizes) {
    sizes.require(AlembicType::int32, 1);
    sizes_ = sizes.arranged(values.stored<std::int32_t>(sizes));
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        if (sizes_[i] < 0)
            sizes.fail(
                "curve " + std::to_string(i) + " has " + std::to_string(sizes_[i]) + " vertices");
        vertices_ += static_cast<std::uint64_t>(sizes_[i]);
    }
    const auto kind = values.parameterOf(geometry, "curveBasisAndType");
    const auto knots = values.parameterOf(geometry, ".knots");
    const auto orders = values.parameterOf(geometry, ".orders");
    const auto weights = values.parameterOf(geometry, "w");
    if (!kind) return;
    kind->require(AlembicType::uint8, 4);
    const auto codes = valueAt<std::array<std::uint8_t, 4>>(values.bytes(), kind->elements.start);
    const auto [type, wrap, basis, basis_again] = codes;
    if (wrap != 0) kind->fail("closed (periodic) curves; only those with two ends are strands");
    if (type == kLinearCurves) return;
    if (type != kCubicCurves && type != kCurvesOfOrders)
        kind->fail("curves of the unknown type " + std::to_string(type));
    if (weights)
        for (const float weight : values.floatsOf<float>(*weights))
            if (weight != 1.0f) weights->fail("rational curves" + std::string(kExportLinear));
    if (knots) {
        readKnots(values, *knots, orders);
        return;
    }
    if (type == kCurvesOfOrders)
        kind->fail("curves of variable order without knots" + std::string(kExportLinear));
    if (basis >= kAlembicBases.size() || !kAlembicBases[basis].weights)
        kind->fail(
            "cubic curves of " +
            (basis < kAlembicBases.size() ? std::string(kAlembicBases[basis].name)
                                          : "the basis " + std::to_string(basis)) +
            std::string(kExportLinear));
    basis_ = &kAlembicBases[basis];
}

void AlembicTopology::readKnots(
    const AlembicValues& values, const AlembicParameter& knots,
    const std::optional<AlembicParameter>& orders) {
    constexpr std::uint32_t kCubicOrder = 4;
    std::vector<std::int32_t> all(sizes_.size(), kCubicOrder);
    if (orders) all = values.integersOf(*orders);
    if (all.size() == 1) all.resize(sizes_.size(), std::int32_t{all.front()});
    if (all.size() != sizes_.size())
        orders->fail(
            std::to_string(all.size()) + " orders of " + std::to_string(sizes_.size()) + " curves");
    knots_ = values.floatsOf<float>(knots);
    requireFinite(knots_, knots.elements.start, knots.path);
    nurbs_.reserve(sizes_.size());
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const auto size = static_cast<std::uint32_t>(sizes_[i]);
        const std::string curve = "curve " + std::to_string(i);
        if (all[i] < 2 || all[i] > static_cast<std::int32_t>(AlembicKnots::kGreatestOrder))
            knots.fail(curve + " has the order " + std::to_string(all[i]) + ", expected 2 to 16");
        const auto order = static_cast<std::uint32_t>(all[i]);
        if (size < order && size > 1)
            knots.fail(
                curve + " has " + std::to_string(size) + " vertices, too few for order " +
                std::to_string(order));
        if (knots_.size() - first < std::uint64_t{size} + order)
            knots.fail(curve + " has too few knots, expected as many as vertices and its order");
        const auto own = std::span(knots_).subspan(first, std::size_t{size} + order);
        if (!std::ranges::is_sorted(own)) knots.fail(curve + " has knots that decrease");
        std::uint32_t segments = 0;  // none of a curve that is a point
        for (std::size_t k = order - 1; k < size; ++k) segments += own[k] < own[k + 1] ? 1 : 0;
        if (segments == 0 && size > 1) knots.fail(curve + " has knots that are all equal");
        nurbs_.push_back({first, order, segments});
        first += own.size();
    }
    if (first != knots_.size())
        knots.fail(
            std::to_string(knots_.size()) + " knots, but the curves have " + std::to_string(first));
}

void AlembicKnots::go(std::uint32_t segment, double t) {
    while (next_segment_ <= segment) {
        do ++span_;
        while (!(knots_[span_] < knots_[span_ + 1]));
        ++next_segment_;
    }
    const double from = knots_[span_];
    const double to = knots_[span_ + 1];
    const double at = t == 1.0 ? to : from + t * (to - from);
    weights_[0] = 1.0;
    for (std::uint32_t degree = 1; degree < order_; ++degree) {
        double saved = 0.0;
        for (std::uint32_t r = 0; r < degree; ++r) {
            const double right = knots_[span_ + r + 1];
            const double left = knots_[span_ + r + 1 - degree];
            const double part = weights_[r] / (right - left);
            weights_[r] = saved + (right - at) * part;
            saved = (at - left) * part;
        }
        weights_[degree] = saved;
    }
}

// Whether each curve begins and ends with two vertices in one place.
bool AlembicTopology::hasDoubledEnds(std::span<const glm::vec3> vertices) const {
    std::size_t first = 0;
    for (const std::int32_t size : sizes_) {
        const auto own = vertices.subspan(first, static_cast<std::size_t>(size));
        first += own.size();
        if (own.size() <= 1) continue;
        if (own.size() < 4 || own[0] != own[1] || own[own.size() - 2] != own.back()) return false;
    }
    return true;
}

void AlembicTopology::draw(std::span<const glm::vec3> vertices, const AlembicParameter& sizes) {
    is_pinned_ = basis_ && basis_->weights == &kCatmullRomBasis && !hasDoubledEnds(vertices);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const auto size = static_cast<std::uint32_t>(sizes_[i]);
        if (size <= 1) continue;  // a point, or nothing, which usableStrands() leaves out
        const bool is_curve =
            !basis_ || (is_pinned_ ? size >= 2 : size >= 4 && (size - 4) % basis_->step == 0);
        if (!is_curve)
            sizes.fail(
                "curve " + std::to_string(i) + " has " + std::to_string(size) +
                " vertices, which do not make a cubic " + std::string(basis_->name) + " curve");
        const std::uint32_t segments = segmentsOf(i);
        pieces_ = std::max(pieces_, (size - 1 + segments - 1) / segments);
    }
}

std::uint64_t AlembicTopology::ends() const {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < sizes_.size(); ++i)
        count += sizes_[i] == 0 ? 0 : std::uint64_t{segmentsOf(i)} + 1;
    return count;
}

}  // namespace hair::groom
