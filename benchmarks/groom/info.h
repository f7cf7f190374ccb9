#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/mesh.h"

// Describes files of hair for `hairbench groom`, and chooses guides from strands.
namespace benchmarks::groom {

// Guides chosen from strands, with every attribute except root triangles.
struct GuideChoice {
    hair::groom::StrandSet guides;
    // Text for people: the error of strands made from the guides alone, and of strands that a scene
    // draws from the file and as many guides.
    std::string error;
    std::string left;
};

// Chooses `count` guides. Throws engine::Error if there are fewer strands.
GuideChoice
chooseGuides(const hair::groom::StrandSet& strands, std::uint32_t count, std::uint32_t seed);

// Finds the root triangles of the strands. `mesh` is the mesh that they grow on, or null.
std::vector<std::array<std::uint32_t, 3>>
rootTriangles(const hair::groom::StrandSet& strands, const hair::groom::Mesh* mesh);

// A property of a groom that its maker may not have intended.
struct Oddity {
    std::string_view name;  // snake_case
    std::uint64_t count = 0;  // number of odd elements
    std::string what;
    std::string advice;
};

std::vector<Oddity>
findOddities(const hair::groom::StrandSet& strands, const hair::groom::StrandFindings& findings);

// All that `hairbench groom info` reports about a file.
struct GroomInfo {
    std::filesystem::path file;
    std::string_view format;
    const hair::groom::StrandSet& strands;
    const hair::groom::StrandFindings& findings;
    std::vector<Oddity> oddities;
};

inline constexpr std::string_view kGroomSchema = "hairbench-groom/1.0.0";

// Text for a terminal; oddities come last.
std::string groomInfoText(const GroomInfo& info);

// Returns the findings as JSON. Lengths are in metres; unknown values are absent.
std::string groomInfoJson(const GroomInfo& info);

}  // namespace benchmarks::groom
