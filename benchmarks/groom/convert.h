#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

// Conversion of a file of hair into another, with what is done to the strands on the way.
namespace benchmarks::groom {

struct ConvertOptions {
    std::filesystem::path in;
    std::filesystem::path out;
    std::filesystem::path mesh;  // for root triangles; empty: from the roots alone
    std::uint32_t points_per_strand = 0;  // of IN, where it doesn't say it
    std::optional<double> scale;  // metres in IN's unit; OUT is then in metres
    std::uint32_t followers = 0;  // for each strand
    double follower_radius = 0.0;  // of the disc that they are in, in IN's unit
    double tip_separation = 1.0;  // factor of their displacement at the tip
    std::optional<std::uint32_t> vertices;  // of a strand
    std::optional<std::uint32_t> guides;  // to keep; all strands
    std::uint32_t seed = 1;
};

// What a conversion says while it works: a line of what it has done, and what a file lacks, cannot
// hold or has that looks wrong.
struct ConvertLog {
    std::function<void(const std::string& line)> say;
    std::function<void(const std::filesystem::path& file, const std::string& warning)> warn;
};

// Reads IN, edits its strands as the options ask (scale, followers, vertices, guides, in this
// order), and writes OUT in one step. Throws engine::Error for options that do not fit together,
// before it reads anything, and for files that can't be read or written; Interrupted, where OUT is
// what it was.
void convert(const ConvertOptions& options, const ConvertLog& log);

}  // namespace benchmarks::groom
