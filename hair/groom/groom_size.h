#pragma once

#include <cstdint>

// Counts of a groom, to estimate sizes before it is built.
namespace hair::groom {

struct Groom;

// The counts that determine the memory of a groom.
struct GroomSize {
    std::uint64_t guides = 0;
    std::uint64_t vertices_per_guide = 0;
    std::uint64_t root_triangles = 0;
    std::uint64_t bound_strands = 0;
    std::uint64_t bound_points = 0;
    std::uint64_t cached_points = 0;  // of all samples
    std::uint64_t root_normals = 0;
    std::uint64_t grouped_guides = 0;  // guides with groups, all or none
    std::uint64_t grouped_strands = 0;  // bound strands with groups, all or none

    std::uint64_t vertices() const { return guides * vertices_per_guide; }
};

GroomSize sizeOf(const Groom& groom);

}  // namespace hair::groom
