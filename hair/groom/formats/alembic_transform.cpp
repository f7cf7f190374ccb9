#include "hair/groom/formats/alembic_transform.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hair::groom {
namespace {

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

}  // namespace hair::groom
