#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"

namespace hair::groom {

// The curves of every UsdGeomBasisCurves in a stage of Universal Scene Description (.usd, .usda,
// .usdc, .usdz), read by usd_curves.py, whose comments say how. Throws engine::Error: where the
// project's Python environment is missing, for a file that has no path, with the tool's last words.
StrandSet importUsd(const StrandFile& file);

// The control meshes of every UsdGeomMesh of a stage that is to be rendered, read by usd_mesh.py,
// whose comments say how, without textures; what the stage refers to is not checked. Its errors
// don't name the file; as importUsd()'s.
Mesh importUsdMesh(
    const std::filesystem::path& path, Textures textures, const NamedFileCheck& check);

// Where the vertices of importUsdMesh() are over time: linear between.
struct UsdSamples {
    std::vector<double> times;  // [sample], s, ascending from 0; empty: nothing moves
    std::vector<glm::vec3> positions;  // [sample][vertex], m
};
UsdSamples readUsdSamples(const std::filesystem::path& path);

// What usd_curves.py writes, little-endian: this header, then what it counts, in its order and with
// nothing between.
struct UsdStreamHeader {
    static constexpr std::array<char, 8> kMagic{'H', 'B', 'C', 'U', 'R', 'V', 'E', 'S'};

    std::array<char, 8> magic;
    double metres_per_unit;
    std::uint64_t strands;  // uint32: points of each
    std::uint64_t points;  // float32[3]
    std::uint64_t widths;  // float32; 0, 1 (everywhere) or a value for each point
    std::uint64_t transparencies;  // float32; 0, 1 (everywhere) or a value for each point
    std::uint64_t colors;  // float32[3]; 0, 1 (everywhere) or a value for each point
    std::uint64_t root_uvs;  // float32[2]; 0 or one for each strand
    std::uint64_t root_triangles;  // uint32[3]
    std::uint64_t groups;  // int32; 0 or one for each strand
    std::uint64_t guides;  // uint8; 0 or one for each strand, 0 or 1
    std::uint64_t comment;  // bytes of UTF-8
    std::uint64_t warnings;  // bytes of UTF-8, a line for each
};
static_assert(sizeof(UsdStreamHeader) == 104);

// Refuses what is not exactly such a stream. Throws engine::Error "byte N: reason".
StrandSet readUsdStream(std::span<const std::byte> bytes);

}  // namespace hair::groom
