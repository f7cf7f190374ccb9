#include "hair/simulation/bodies.h"

#include <cassert>
#include <cstddef>
#include <string>

#include "engine/error.h"
#include "engine/transfer.h"

namespace hair {

namespace {

static_assert(sizeof(gpu::Capsule) == 32 && offsetof(gpu::Capsule, b) == 16);
static_assert(sizeof(gpu::BodyField) == 48);

std::uint32_t toGpu(Follows follows) {
    return follows == Follows::head ? gpu::kFollowsHead : gpu::kFollowsWorld;
}

std::vector<gpu::Capsule> capsulesOf(const SimulationSettings& settings) {
    std::vector<gpu::Capsule> capsules;
    for (const Collider& collider : settings.colliders)
        capsules.push_back(
            {.a = collider.a,
             .radius = collider.radius,
             .b = collider.b,
             .follows = toGpu(collider.follows)});
    return capsules;
}

std::vector<DistanceField> bake(
    const engine::Device& device, const SimulationSettings& settings,
    std::span<const Mesh> meshes) {
    assert(meshes.size() == settings.distance_fields.size());
    std::vector<DistanceField> fields;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        try {
            // Beyond the grid nothing touches, not by a rounding either.
            fields.emplace_back(
                device, meshes[i], settings.distance_fields[i].resolution,
                1.01f * settings.collision.margin);
        } catch (const engine::Unsupported&) {
            throw;
        } catch (const engine::Error& error) {
            throw engine::Error("/simulation/distance_fields/" + std::to_string(i), error.what());
        }
    }
    return fields;
}

std::vector<gpu::BodyField>
fieldsOf(const SimulationSettings& settings, const std::vector<DistanceField>& fields) {
    std::vector<gpu::BodyField> result;
    for (std::size_t i = 0; i < fields.size(); ++i)
        result.push_back(
            {.field = fields[i].parameters(),
             .follows = toGpu(settings.distance_fields[i].follows)});
    return result;
}

}  // namespace

Bodies::Bodies(
    const engine::Device& device, const SimulationSettings& settings, std::span<const Mesh> meshes)
    : distances_(bake(device, settings, meshes)), capsules_(makeCapsules(device, settings)),
      fields_(engine::makeBuffer(
          device, std::span<const gpu::BodyField>(fieldsOf(settings, distances_)),
          "distance fields")),
      margin_(settings.collision.margin), friction_(settings.collision.friction) {}

gpu::Bodies Bodies::parametersWith(const Capsules& capsules) const {
    return {
        .capsules = capsules.buffer.address(),
        .fields = fields_.address(),
        .capsule_count = capsules.count,
        .field_count = static_cast<std::uint32_t>(distances_.size()),
        .margin = margin_,
        .friction = friction_};
}

Bodies::Capsules
Bodies::makeCapsules(const engine::Device& device, const SimulationSettings& settings) {
    return {
        .buffer = engine::makeBuffer(
            device, std::span<const gpu::Capsule>(capsulesOf(settings)), "capsules"),
        .count = static_cast<std::uint32_t>(settings.colliders.size())};
}

}  // namespace hair
