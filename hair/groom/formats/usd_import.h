#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

namespace hair::groom {

// The curves of every UsdGeomBasisCurves in a stage of Universal Scene Description (.usd, .usda,
// .usdc, .usdz), read by usd_curves.py, whose comments say how. Throws engine::Error: where the
// project's Python environment is missing, for a file that has no path, with the tool's last words.
StrandSet importUsd(const StrandFile& file);

// Runs a program, without a shell and with nothing to read, and returns what it wrote to stdout.
// Throws engine::Error: the last line that it wrote to stderr if it fails, how it ended if it wrote
// none; std::errc::no_such_file_or_directory as std::system_error where there is no such program.
std::vector<std::byte> runTool(const std::vector<std::string>& arguments);

// Runs a program as the function above does, hands over each line that it writes to stdout, without
// its end, as soon as it is there, and calls `poll` some ten times a second while there is nothing.
// What either throws ends the program.
void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll = {});

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
