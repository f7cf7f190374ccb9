#include "engine/acceleration.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/error.h"
#include "engine/transfer.h"

namespace engine {
namespace {

constexpr const char* kLower = "acceleration structure";
constexpr const char* kUpper = "acceleration top level";
constexpr const char* kInstance = "acceleration instance";
constexpr const char* kScratch = "acceleration scratch";

const char* nameOf(PrimitiveSet::Kind kind) {
    return kind == PrimitiveSet::Kind::boxes ? "boxes" : "triangles";
}

VkPhysicalDeviceAccelerationStructurePropertiesKHR limitsOf(const Device& device) {
    VkPhysicalDeviceAccelerationStructurePropertiesKHR limits{};
    limits.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &limits;
    vkGetPhysicalDeviceProperties2(device.info().handle, &properties);
    return limits;
}

VkAccelerationStructureGeometryKHR geometryOf(VkGeometryTypeKHR type) {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = type;
    return geometry;
}

VkAccelerationStructureGeometryKHR
trianglesGeometry(const PrimitiveSet& of, VkDeviceAddress vertices, VkDeviceAddress indices) {
    VkAccelerationStructureGeometryKHR geometry = geometryOf(VK_GEOMETRY_TYPE_TRIANGLES_KHR);
    if (of.is_opaque) geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
    triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = vertices;
    triangles.vertexStride = 3 * sizeof(float);
    triangles.maxVertex = std::max(of.vertices, 1u) - 1;
    triangles.indexType = VK_INDEX_TYPE_UINT32;
    triangles.indexData.deviceAddress = indices;
    return geometry;
}

VkAccelerationStructureGeometryKHR
boxesGeometry(const PrimitiveSet& of, VkDeviceAddress first_box) {
    VkAccelerationStructureGeometryKHR geometry = geometryOf(VK_GEOMETRY_TYPE_AABBS_KHR);
    VkAccelerationStructureGeometryAabbsDataKHR& boxes = geometry.geometry.aabbs;
    boxes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR;
    boxes.data.deviceAddress = first_box;
    boxes.stride = of.box_stride;
    return geometry;
}

// Addresses may be 0 if only sizes are asked for.
VkAccelerationStructureGeometryKHR
lowerGeometry(const PrimitiveSet& of, VkDeviceAddress primitives, VkDeviceAddress indices) {
    return of.kind == PrimitiveSet::Kind::boxes ? boxesGeometry(of, primitives)
                                                : trianglesGeometry(of, primitives, indices);
}

VkAccelerationStructureGeometryKHR upperGeometry(VkDeviceAddress instance) {
    VkAccelerationStructureGeometryKHR geometry = geometryOf(VK_GEOMETRY_TYPE_INSTANCES_KHR);
    VkAccelerationStructureGeometryInstancesDataKHR& instances = geometry.geometry.instances;
    instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
    instances.data.deviceAddress = instance;
    return geometry;
}

VkBuildAccelerationStructureFlagsKHR lowerFlags(Rebuild rebuild) {
    return rebuild == Rebuild::anew ? VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR
                                    : VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR |
                                          VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
}

constexpr VkBuildAccelerationStructureFlagsKHR kUpperFlags =
    VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR;

VkAccelerationStructureBuildGeometryInfoKHR buildOf(
    VkAccelerationStructureTypeKHR type, VkBuildAccelerationStructureFlagsKHR flags,
    const VkAccelerationStructureGeometryKHR& geometry) {
    VkAccelerationStructureBuildGeometryInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
    info.type = type;
    info.flags = flags;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = 1;
    info.pGeometries = &geometry;
    return info;
}

VkAccelerationStructureBuildSizesInfoKHR sizesOf(
    const Device& device, const VkAccelerationStructureBuildGeometryInfoKHR& info,
    std::uint32_t primitives) {
    VkAccelerationStructureBuildSizesInfoKHR sizes{};
    sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
    vkGetAccelerationStructureBuildSizesKHR(
        device.get(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &primitives, &sizes);
    return sizes;
}

VkAccelerationStructureKHR makeStructure(
    const Device& device, VkAccelerationStructureTypeKHR type, const Buffer& storage,
    const char* name) {
    VkAccelerationStructureCreateInfoKHR create{};
    create.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
    create.buffer = storage.get();
    create.size = storage.size();
    create.type = type;
    VkAccelerationStructureKHR structure{};
    check(
        vkCreateAccelerationStructureKHR(device.get(), &create, nullptr, &structure),
        "create an acceleration structure");
    device.setName(
        VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, reinterpret_cast<std::uint64_t>(structure),
        name);
    return structure;
}

VkDeviceAddress addressOf(const Device& device, VkAccelerationStructureKHR structure) {
    VkAccelerationStructureDeviceAddressInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
    info.accelerationStructure = structure;
    return vkGetAccelerationStructureDeviceAddressKHR(device.get(), &info);
}

// The structure at its place in the world.
VkAccelerationStructureInstanceKHR instanceOf(VkDeviceAddress structure) {
    VkAccelerationStructureInstanceKHR instance{};
    for (std::uint32_t i = 0; i < 3; ++i) instance.transform.matrix[i][i] = 1.0f;
    instance.mask = 0xff;
    instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
    instance.accelerationStructureReference = structure;
    return instance;
}

void record(
    Commands& commands, const VkAccelerationStructureBuildGeometryInfoKHR& info,
    std::uint32_t primitives) {
    const VkAccelerationStructureBuildRangeInfoKHR range{
        .primitiveCount = primitives, .primitiveOffset = 0, .firstVertex = 0, .transformOffset = 0};
    const VkAccelerationStructureBuildRangeInfoKHR* const ranges = &range;
    commands.order();
    vkCmdBuildAccelerationStructuresKHR(commands.get(), 1, &info, &ranges);
}

}  // namespace

MemoryRows AccelerationStructure::rows(const Device& device, const PrimitiveSet& primitives) {
    const VkPhysicalDeviceAccelerationStructurePropertiesKHR limits = limitsOf(device);
    if (primitives.count > limits.maxPrimitiveCount)
        throw Unsupported(
            "acceleration structure", std::to_string(primitives.count) + " " +
                                          nameOf(primitives.kind) + "; the device allows " +
                                          std::to_string(limits.maxPrimitiveCount));
    const VkAccelerationStructureGeometryKHR lower_geometry = lowerGeometry(primitives, 0, 0);
    const VkAccelerationStructureGeometryKHR upper_geometry = upperGeometry(0);
    const VkAccelerationStructureBuildSizesInfoKHR lower = sizesOf(
        device,
        buildOf(
            VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, lowerFlags(primitives.rebuild),
            lower_geometry),
        primitives.count);
    const VkAccelerationStructureBuildSizesInfoKHR upper = sizesOf(
        device, buildOf(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, kUpperFlags, upper_geometry),
        1);
    const VkDeviceSize scratch = std::max(
        {lower.buildScratchSize, lower.updateScratchSize, upper.buildScratchSize, VkDeviceSize{1}});
    return {
        "acceleration",
        {{kLower, static_cast<std::size_t>(lower.accelerationStructureSize)},
         {kUpper, static_cast<std::size_t>(upper.accelerationStructureSize)},
         {kInstance, sizeof(VkAccelerationStructureInstanceKHR)},
         {kScratch, static_cast<std::size_t>(
                        scratch + limits.minAccelerationStructureScratchOffsetAlignment)}}};
}

bool AccelerationStructure::leavesOutNan(const Device& device) {
    return device.info().driver_id != VK_DRIVER_ID_MESA_LLVMPIPE;
}

AccelerationStructure::AccelerationStructure(const Device& device, const PrimitiveSet& primitives)
    : primitives_(primitives) {
    device.require(Feature::ray_queries, kLower);
    const MemoryRows rows = AccelerationStructure::rows(device, primitives);
    lower_storage_ = {device, rows[kLower]};
    upper_storage_ = {device, rows[kUpper]};
    lower_ = {
        device.get(),
        makeStructure(
            device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, lower_storage_, kLower)};
    upper_ = {
        device.get(),
        makeStructure(
            device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, upper_storage_, kUpper)};
    instance_ = makeBuffer(
        device, std::array{instanceOf(addressOf(device, lower_.get()))}, rows, kInstance);
    scratch_ = {device, rows[kScratch]};
    const std::uint64_t alignment =
        std::max(limitsOf(device).minAccelerationStructureScratchOffsetAlignment, 1u);
    scratch_address_ = (scratch_.address() + alignment - 1) / alignment * alignment;
    upper_address_ = addressOf(device, upper_.get());
}

void AccelerationStructure::build(
    Commands& commands, const Buffer& primitives, const Buffer* indices) {
    const bool refits = primitives_.rebuild == Rebuild::refit && is_built_;
    commands.uses(
        {{primitives, Access::build_read},
         {lower_storage_, Access::build_write},
         {scratch_, Access::build_write}});
    const VkAccelerationStructureGeometryKHR lower_geometry =
        lowerGeometry(primitives_, primitives.address(), indices ? indices->address() : 0);
    VkAccelerationStructureBuildGeometryInfoKHR lower = buildOf(
        VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, lowerFlags(primitives_.rebuild),
        lower_geometry);
    if (refits) {
        lower.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR;
        lower.srcAccelerationStructure = lower_.get();
    }
    lower.dstAccelerationStructure = lower_.get();
    lower.scratchData.deviceAddress = scratch_address_;
    record(commands, lower, primitives_.count);
    is_built_ = true;

    commands.uses(
        {{lower_storage_, Access::build_read},
         {upper_storage_, Access::build_write},
         {scratch_, Access::build_write}});
    const VkAccelerationStructureGeometryKHR upper_geometry = upperGeometry(instance_.address());
    VkAccelerationStructureBuildGeometryInfoKHR upper =
        buildOf(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, kUpperFlags, upper_geometry);
    upper.dstAccelerationStructure = upper_.get();
    upper.scratchData.deviceAddress = scratch_address_;
    record(commands, upper, 1);
}

std::uint64_t AccelerationStructure::traces(Commands& commands, Access access) const {
    commands.uses({{lower_storage_, access}, {upper_storage_, access}});
    return upper_address_;
}

}  // namespace engine
