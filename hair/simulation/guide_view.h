#pragma once

#include <cstdint>

namespace hair::simulation {

// Where the guides are on the device, for who draws them. Valid as long as the simulation that gave
// it.
struct GuideView {
    // Device address of vec4 [strand][vertex], root first, m; w: inverse mass.
    std::uint64_t positions = 0;
    // Device address of vec4 [strand][vertex]; w: 1 where in contact with a body and at all
    // vertices below, else 0.
    std::uint64_t contacts = 0;
    std::uint32_t strand_count = 0;
    std::uint32_t vertices_per_strand = 0;
};

}  // namespace hair::simulation
