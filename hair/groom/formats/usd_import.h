#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/run_tool.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/strand_format.h"

namespace hair::groom {

// A script of this folder that reads or writes files for the program.
struct FormatScript {
    std::string script;  // "usd_curves.py"
    std::string what;  // for messages: "USD"
    std::string library;  // "usd-core"
};

// Runs it in the project's Python environment with these limits. If `reads` is among them, it gets
// the interpreter's own folders too. Returns its stdout. Throws engine::Error if the environment is
// missing, and with the last line of the script's errors if it fails.
std::vector<std::byte> runScript(
    const FormatScript& tool, const std::vector<std::string>& arguments,
    engine::ChildLimits limits);

// Throws engine::Error if the environment is missing. `what` is for the message: "USD".
void requireScripts(const std::string& what);

// Reads the curves of every UsdGeomBasisCurves and UsdGeomNurbsCurves in a stage of Universal Scene
// Description (.usd, .usda, .usdc, .usdz) by usd_curves.py; its comments have the details. Throws
// engine::Error if the project's Python environment is missing, for a file without a path, and with
// the last line of the tool's errors if it fails.
StrandSet importUsd(const StrandFile& file);

// The strands of importUsd() over time. Other errors than those: strands whose number, or number of
// points, changes, with the time.
StrandSamples importUsdCache(const StrandFile& file);

// Reads the control meshes of every UsdGeomMesh of a stage that is rendered, by usd_mesh.py; its
// comments have the details. Textures are not read, and files that the stage refers to are not
// checked. Errors don't name the file; otherwise they are those of importUsd().
Mesh importUsdMesh(
    const std::filesystem::path& path, Textures textures, const NamedFileCheck& check);

// The positions of importUsdMesh()'s vertices over time, linear between samples.
struct UsdSamples {
    std::vector<double> times;  // [sample], s, ascending from 0; empty: nothing moves
    std::vector<glm::vec3> positions;  // [sample][vertex], m
};
UsdSamples readUsdSamples(const std::filesystem::path& path, const NamedFileCheck& check = {});

// The output of usd_curves.py, little-endian: this header, then the counted arrays in its order,
// without padding.
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
    std::uint64_t stated;  // bit 0: the stage states its unit; bit 1: its upward axis
};
static_assert(sizeof(UsdStreamHeader) == 112);

// Refuses malformed streams. Throws engine::Error "byte N: reason".
StrandSet readUsdStream(std::span<const std::byte> bytes);

}  // namespace hair::groom
