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

// The bodies that rays may meet.
struct PrimitiveSet {
    enum class Kind {
        triangles,  // three 32-bit indices each
        boxes,  // along the axes; the shader says whether a ray meets what is inside
    };
    Kind kind = Kind::triangles;
    std::uint32_t count = 0;  // of triangles or boxes
    std::uint32_t vertices = 0;  // of triangles: vec3
    std::uint32_t box_stride = 0;  // B, a multiple of 8; a box is two vec3, its corners
    // Rays take the nearest triangle without asking the shader.
    bool is_opaque = true;
    Rebuild rebuild = Rebuild::anew;
};

// An acceleration structure of triangles or boxes, for ray queries: one structure that has these,
// and one above it that has the first as its only instance, because rays begin there. Needs
// Feature::ray_queries.
class AccelerationStructure {
public:
    // Throws Unsupported for more primitives than the device allows.
    static MemoryRows rows(const Device& device, const PrimitiveSet& primitives);

    AccelerationStructure(const Device& device, const PrimitiveSet& primitives);

    // Whether triangles with a vertex whose x is NaN are left out, and boxes with NaN as their
    // least x, as Vulkan demands. With Rebuild::refit they must always be the same ones. In
    // lavapipe of Mesa 25 such a triangle hides the others.
    static bool leavesOutNan(const Device& device);

    // Records the building from `primitives`: vec3 [vertex] with `indices`, uint [triangle][3], or
    // boxes, for which `indices` is null. With Rebuild::refit only the first call builds.
    void build(Commands& commands, const Buffer& primitives, const Buffer* indices = nullptr);

    // For accelerationStructureEXT() in shaders.
    std::uint64_t address() const { return upper_address_; }
    // Declares that the next dispatch traces rays (Access::trace_read), or that fragments of the
    // next rendering do (Access::fragment_trace), and returns the address.
    std::uint64_t traces(Commands& commands, Access access = Access::trace_read) const;

private:
    using Structure = Handle<VkAccelerationStructureKHR, &vkDestroyAccelerationStructureKHR>;

    PrimitiveSet primitives_;
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
