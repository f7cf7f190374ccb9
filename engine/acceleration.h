#pragma once

#include <cstdint>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"

namespace engine {

// The work on a structure whose vertices have moved.
enum class Rebuild {
    anew,   // it is built again: slower, but tight round the triangles
    refit,  // its boxes are fitted to the triangles, which stay in the groups of the first time
};

struct TriangleSet {
    std::uint32_t vertices = 0;  // vec3
    std::uint32_t triangles = 0;  // three 32-bit indices each
    // Rays take the nearest triangle without asking the shader.
    bool is_opaque = true;
    Rebuild rebuild = Rebuild::anew;
};

// An acceleration structure of triangles, for ray queries: one structure that has the triangles,
// and one above it that has the first as its only instance, because rays begin there. Needs
// Feature::ray_queries.
class TriangleStructure {
public:
    // Throws Unsupported for more triangles than the device allows.
    static MemoryRows rows(const Device& device, const TriangleSet& triangles);

    TriangleStructure(const Device& device, const TriangleSet& triangles);

    // Whether triangles with a vertex whose x is NaN are left out, as Vulkan demands. With
    // Rebuild::refit they must always be the same ones. In lavapipe of Mesa 25 such a triangle
    // hides the others.
    static bool leavesOutNan(const Device& device);

    // Records the building from `vertices`, vec3 [vertex], and `indices`, uint [triangle][3]. With
    // Rebuild::refit only the first call builds.
    void build(Commands& commands, const Buffer& vertices, const Buffer& indices);

    // Declares that the next dispatch traces rays, and returns the structure's address for
    // accelerationStructureEXT() in shaders.
    std::uint64_t traces(Commands& commands) const;

private:
    using Structure = Handle<VkAccelerationStructureKHR, &vkDestroyAccelerationStructureKHR>;

    TriangleSet triangles_;
    bool is_built_ = false;
    Buffer lower_storage_;
    Buffer upper_storage_;
    Structure lower_;
    Structure upper_;
    Buffer instance_;  // VkAccelerationStructureInstanceKHR
    Buffer scratch_;
    std::uint64_t scratch_address_ = 0;  // aligned
    std::uint64_t upper_address_ = 0;
};

}  // namespace engine
