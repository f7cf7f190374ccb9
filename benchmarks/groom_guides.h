#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/strand_set.h"

namespace benchmarks {

// Guides chosen from strands, with all that those have but root triangles.
struct GuideChoice {
    hair::StrandSet guides;
    std::string error;  // of the strands that are made from them, for people
};

// Throws engine::Error if there are fewer strands.
GuideChoice chooseGuides(const hair::StrandSet& strands, std::uint32_t count, std::uint32_t seed);

// `mesh`: what the strands grow on, or null.
std::vector<std::array<std::uint32_t, 3>>
rootTriangles(const hair::StrandSet& strands, const hair::Mesh* mesh);

}  // namespace benchmarks
