#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace hair {

// Bits of HairHeader::arrays.
enum class HairArray : std::uint32_t {
    segments = 1,
    points = 2,
    thickness = 4,
    transparency = 8,
    colors = 16,
};
inline constexpr std::uint32_t kAllHairArrays = 31;

// The beginning of a .hair file as it lies there; import_hair.h says what follows.
struct HairHeader {
    std::array<char, 4> magic{'H', 'A', 'I', 'R'};
    std::uint32_t hair_count = 0;
    std::uint32_t point_count = 0;
    std::uint32_t arrays = 0;
    // Where there is no array. Transparency and colour are what the format's author begins with.
    std::uint32_t default_segments = 0;
    float default_thickness = 0.0f;  // 0: not known
    float default_transparency = 0.0f;
    glm::vec3 default_color{1.0f, 1.0f, 1.0f};
    std::array<char, 88> info{};  // text, ended by a 0 where it is shorter

    bool has(HairArray array) const { return (arrays & static_cast<std::uint32_t>(array)) != 0; }
    void add(HairArray array) { arrays |= static_cast<std::uint32_t>(array); }
};
static_assert(sizeof(HairHeader) == 128);
static_assert(offsetof(HairHeader, default_color) == 28 && offsetof(HairHeader, info) == 40);

}  // namespace hair
