#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// Converts a file of hair into another format, with edits of the strands on the way.
namespace benchmarks::groom {

struct ConvertOptions {
    std::filesystem::path in;
    std::filesystem::path out;
    std::filesystem::path mesh;  // for root triangles; empty: use the roots alone
    std::uint32_t points_per_strand = 0;  // of IN, if it does not state it
    bool strict = false;  // refuse strands that can't be used
    std::optional<double> scale;  // metres per unit of IN; OUT is then in metres or in `unit`
    std::string unit;  // of OUT: "m", "cm", "mm" or "inch"; empty: stays
    std::string from_up;  // upward axis of IN: "x", "y" or "z"; empty: as IN states
    std::string up;  // upward axis of OUT; empty: stays
    std::string program;  // that is to read OUT, of programNames(); empty: none in particular
    std::uint32_t followers = 0;  // per strand
    double follower_radius = 0.0;  // radius of their disc, in IN's unit
    double tip_separation = 1.0;  // factor of their displacement at the tip
    std::optional<std::uint32_t> vertices;  // per strand
    std::optional<std::uint32_t> guides;  // number to keep; absent: all strands
    std::uint32_t seed = 1;
};

// Messages of a conversion: finished steps, and warnings about a file that lacks something, cannot
// hold something or looks wrong.
struct ConvertLog {
    std::function<void(const std::string& line)> say;
    std::function<void(const std::filesystem::path& file, const std::string& warning)> warn;
};

// Programs with presets for OUT.
std::vector<std::string> programNames();

// Returns the number of an axis "x", "y" or "z"; nothing for "".
std::optional<std::uint8_t> axisOf(const std::string& name);

// Reads IN, edits its strands by the options (scale, followers, vertices, guides, in this order),
// changes unit and axis last,
// and writes OUT atomically. Throws engine::Error for options that do not fit together, before
// reading anything, and for files that cannot be read or written. Throws Interrupted and then
// leaves OUT unchanged.
void convert(const ConvertOptions& options, const ConvertLog& log);

}  // namespace benchmarks::groom
