#pragma once

#include <cstdint>

namespace hair::simulation {

// Device addresses of the guides, for passes that move them.
struct GuideAddresses {
    std::uint64_t parameters = 0;  // gpu::GuideParameters, including the next two
    std::uint64_t positions = 0;
    std::uint64_t previous = 0;
    std::uint64_t accelerations = 0;  // vec4 [strand][vertex], m/s^2, without gravity; 0: none
};

// The guides on the device, for code that draws them. Valid as long as the simulation that returned
// it.
struct GuideView {
    // Device address of vec4 [strand][vertex], root first, m; w: inverse mass.
    std::uint64_t positions = 0;
    // Device address of vec4 [strand][vertex]; w: 1 at a vertex in contact with a body and at all
    // vertices below it, else 0.
    std::uint64_t contacts = 0;
    std::uint64_t bodies = 0;  // device address of the gpu::Bodies that the guides collide with
    std::uint32_t strand_count = 0;
    std::uint32_t vertices_per_strand = 0;
};

}  // namespace hair::simulation
