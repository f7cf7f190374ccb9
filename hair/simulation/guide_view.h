#pragma once

#include <cstdint>

namespace hair::simulation {

// Device addresses of the guides, for the passes that move them.
struct GuideAddresses {
    std::uint64_t parameters = 0;  // gpu::GuideParameters, with the next two
    std::uint64_t positions = 0;
    std::uint64_t previous = 0;
    std::uint64_t accelerations = 0;  // vec4 [strand][vertex], m/s^2, beside gravity; 0: none
};

// Where the guides are on the device, for who draws them. Valid as long as the simulation that gave
// it.
struct GuideView {
    // Device address of vec4 [strand][vertex], root first, m; w: inverse mass.
    std::uint64_t positions = 0;
    // Device address of vec4 [strand][vertex]; w: 1 where in contact with a body and at all
    // vertices below, else 0.
    std::uint64_t contacts = 0;
    std::uint64_t bodies = 0;  // device address of the gpu::Bodies that they collide with
    std::uint32_t strand_count = 0;
    std::uint32_t vertices_per_strand = 0;
};

}  // namespace hair::simulation
