#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hair {

// The beginning of a .tfx file as it lies there; import_tfx.h says what follows. Offsets are bytes
// from the beginning of the file, 0 where there is no such array.
struct TfxHeader {
    static constexpr float kVersion = 4.0f;

    float version = kVersion;
    std::uint32_t strands = 0;
    std::uint32_t vertices_per_strand = 0;
    std::uint32_t positions = 0;
    std::uint32_t strand_uvs = 0;
    std::uint32_t vertex_uvs = 0;
    std::uint32_t strand_thickness = 0;
    std::uint32_t vertex_colors = 0;
    std::array<std::uint32_t, 32> reserved{};
};
static_assert(sizeof(TfxHeader) == 160 && offsetof(TfxHeader, vertex_colors) == 28);

}  // namespace hair
