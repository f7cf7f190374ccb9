#include "benchmarks/scene/assets.h"

#include <string>

#include "engine/error.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/rendering/strand_offsets.h"

namespace benchmarks::scene {
namespace {

void checkFields(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& scene) {
    const auto refuse = [&](std::size_t field, const std::string& reason) {
        const std::string pointer = "/simulation/distance_fields/" + std::to_string(field);
        throw engine::Error(scene.string(), pointer + ": " + reason);
    };
    const auto& fields = settings.simulation.distance_fields;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].mesh.empty() && !grown_on)
            refuse(i, "names no mesh, and neither does /groom/mesh");
    const auto meshes = loadFieldMeshes(settings, grown_on, scene.parent_path());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        try {
            hair::groom::closeMesh(meshes[i]);
        } catch (const engine::Error& error) {
            refuse(i, error.what());
        }
    }
}

void checkMeshes(const hair::RenderSettings& render, const std::filesystem::path& scene) {
    for (std::size_t i = 0; i < render.meshes.size(); ++i) {
        if (render.meshes[i].file.empty())
            throw engine::Error(
                scene.string(), "/render/meshes/" + std::to_string(i) + "/file: is empty");
    }
}

}  // namespace

std::optional<hair::groom::Mesh>
loadMesh(const hair::Settings& settings, const std::filesystem::path& directory) {
    const hair::GroomSettings& groom = settings.groom;
    const std::string& file = groom.file.empty() ? groom.grow.mesh : groom.mesh;
    if (file.empty()) return std::nullopt;
    return hair::groom::importMesh(
        directory / file,
        settings.render.head ? hair::groom::Textures::decoded : hair::groom::Textures::skipped);
}

std::vector<hair::groom::Mesh> loadFieldMeshes(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory) {
    std::vector<hair::groom::Mesh> meshes;
    for (const hair::DistanceFieldSettings& field : settings.simulation.distance_fields)
        meshes.push_back(
            field.mesh.empty() ? grown_on.value()
                               : hair::groom::importMesh(directory / field.mesh));
    return meshes;
}

std::optional<hair::groom::StrandSet>
loadOffsets(const hair::Settings& settings, const std::filesystem::path& directory) {
    if (settings.strands.offsets.empty()) return std::nullopt;
    return hair::groom::importStrands(directory / settings.strands.offsets);
}

hair::rendering::RenderAssets loadRenderAssets(
    const hair::Settings& settings, const hair::groom::Mesh* head,
    const std::filesystem::path& directory) {
    hair::rendering::RenderAssets assets{.head = head};
    for (const hair::MeshSettings& mesh : settings.render.meshes)
        assets.meshes.push_back(
            hair::groom::importMesh(directory / mesh.file, hair::groom::Textures::decoded));
    if (settings.render.overlays.bodies) {
        const auto grown_on = head ? std::optional(*head) : std::nullopt;
        assets.field_meshes = loadFieldMeshes(settings, grown_on, directory);
    }
    if (!settings.strands.texture.empty())
        assets.strand_texture = engine::readImage(directory / settings.strands.texture);
    if (!settings.render.environment.empty())
        assets.environment = engine::readFloatImage(directory / settings.render.environment);
    return assets;
}

void checkAssets(const hair::Settings& settings, const std::filesystem::path& scene) {
    const std::filesystem::path directory = scene.parent_path();
    const std::optional<hair::groom::Mesh> mesh = loadMesh(settings, directory);
    const hair::groom::Groom groom =
        hair::groom::buildGroom(settings.groom, mesh ? &*mesh : nullptr, directory, settings.seed);
    checkFields(settings, mesh, scene);
    checkMeshes(settings.render, scene);
    loadRenderAssets(settings, mesh ? &*mesh : nullptr, directory);
    const std::optional<hair::groom::StrandSet> offsets = loadOffsets(settings, directory);
    try {
        hair::rendering::checkStrands(settings.strands, groom);
        if (hair::rendering::hasOffsets(settings.strands))
            hair::rendering::makeStrandOffsets(
                settings.strands, groom, offsets ? &*offsets : nullptr, settings.seed);
    } catch (const engine::Error& error) {
        throw engine::Error(scene.string(), error.what());
    }
}

}  // namespace benchmarks::scene
