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

// What `hairbench groom` says of a file of hair, and guides chosen from strands.
namespace benchmarks::groom {

// Guides chosen from strands, with every attribute but root triangles.
struct GuideChoice {
    hair::groom::StrandSet guides;
    // For people: of the strands that are made from the guides alone, and of those that a scene
    // with the file and as many guides draws.
    std::string error;
    std::string left;
};

// Chooses `count` guides. Throws engine::Error if there are fewer strands.
GuideChoice
chooseGuides(const hair::groom::StrandSet& strands, std::uint32_t count, std::uint32_t seed);

// `mesh`: what the strands grow on, or null.
std::vector<std::array<std::uint32_t, 3>>
rootTriangles(const hair::groom::StrandSet& strands, const hair::groom::Mesh* mesh);

// Something about a groom that its maker may not have meant.
struct Oddity {
    std::string_view name;  // snake_case
    std::uint64_t count = 0;  // of the things that are odd
    std::string what;
    std::string advice;
};

std::vector<Oddity>
findOddities(const hair::groom::StrandSet& strands, const hair::groom::StrandFindings& findings);

// What `hairbench groom info` has to say of a file.
struct GroomInfo {
    std::filesystem::path file;
    std::string_view format;
    const hair::groom::StrandSet& strands;
    const hair::groom::StrandFindings& findings;
    std::vector<Oddity> oddities;
};

inline constexpr std::string_view kGroomSchema = "hairbench-groom/1.0.0";

// For a terminal; what is odd comes last.
std::string groomInfoText(const GroomInfo& info);

// The findings as JSON. Lengths are in metres; what is not known is absent.
std::string groomInfoJson(const GroomInfo& info);

}  // namespace benchmarks::groom
