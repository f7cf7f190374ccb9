#include "benchmarks/assets.h"

#include <string>

#include "engine/error.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/import_mesh.h"
#include "hair/simulation/closed_mesh.h"

namespace benchmarks {

namespace {

void checkFields(
    const hair::Settings& settings, const std::optional<hair::Mesh>& grown_on,
    const std::filesystem::path& scene) {
    const auto refuse = [&](std::size_t field, const std::string& reason) {
        const std::string pointer = "/simulation/distance_fields/" + std::to_string(field);
        throw engine::Error(scene.string(), pointer + ": " + reason);
    };
    const auto& fields = settings.simulation.distance_fields;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].mesh.empty() && !grown_on)
            refuse(i, "names no mesh, and hair from a file grows on none");
    const auto meshes = loadFieldMeshes(settings, grown_on, scene.parent_path());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        try {
            hair::closeMesh(meshes[i]);
        } catch (const engine::Error& error) {
            refuse(i, error.what());
        }
    }
}

}  // namespace

std::optional<hair::Mesh>
loadMesh(const hair::Settings& settings, const std::filesystem::path& directory) {
    if (!settings.groom.file.empty()) return std::nullopt;
    return hair::importMesh(directory / settings.groom.grow.mesh);
}

std::vector<hair::Mesh> loadFieldMeshes(
    const hair::Settings& settings, const std::optional<hair::Mesh>& grown_on,
    const std::filesystem::path& directory) {
    std::vector<hair::Mesh> meshes;
    for (const hair::DistanceFieldSettings& field : settings.simulation.distance_fields)
        meshes.push_back(
            field.mesh.empty() ? grown_on.value() : hair::importMesh(directory / field.mesh));
    return meshes;
}

void checkAssets(const hair::Settings& settings, const std::filesystem::path& scene) {
    const std::optional<hair::Mesh> mesh = loadMesh(settings, scene.parent_path());
    hair::buildGroom(settings.groom, mesh ? &*mesh : nullptr, scene.parent_path(), settings.seed);
    checkFields(settings, mesh, scene);
}

}  // namespace benchmarks
