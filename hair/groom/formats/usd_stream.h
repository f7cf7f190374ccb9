#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hair/groom/strand_set.h"

namespace hair {

// What usd_curves.py writes, little-endian: this header, then what it counts, in its order and with
// nothing between.
struct UsdStreamHeader {
    static constexpr std::array<char, 8> kMagic{'H', 'B', 'C', 'U', 'R', 'V', 'E', 'S'};

    std::array<char, 8> magic;
    double metres_per_unit;
    std::uint64_t strands;  // uint32: points of each
    std::uint64_t points;  // float32[3]
    std::uint64_t widths;  // float32; 0, 1 (everywhere) or a value for each point
    std::uint64_t transparencies;  // the same
    std::uint64_t colors;  // the same, float32[3]
    std::uint64_t root_uvs;  // float32[2]; 0 or one for each strand
    std::uint64_t root_triangles;  // uint32[3]
    std::uint64_t comment;  // bytes of UTF-8
    std::uint64_t warnings;  // bytes of UTF-8, a line for each
};
static_assert(sizeof(UsdStreamHeader) == 88);

// Refuses what is not exactly such a stream. Throws engine::Error "byte N: reason".
StrandSet readUsdStream(std::span<const std::byte> bytes);

}  // namespace hair
