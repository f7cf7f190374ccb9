#include "benchmarks/scene/assets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "hair/fields.h"
#include "hair/groom/build_groom.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/strand_offsets.h"

namespace benchmarks::scene {
namespace {

// Checks the meshes of distance fields. Returns warnings about odd ones.
std::vector<std::string> checkFields(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& scene, const Reach& reach) {
    const auto pointerTo = [](std::size_t field) {
        return "/simulation/distance_fields/" + std::to_string(field);
    };
    const auto refuse = [&](std::size_t field, const std::string& reason) {
        throw engine::Error(scene.string(), pointerTo(field) + ": " + reason);
    };
    const auto& fields = settings.simulation.distance_fields;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].mesh.empty() && !grown_on)
            refuse(i, "names no mesh, and neither does /groom/mesh");
    const auto meshes = loadFieldMeshes(settings, grown_on, scene.parent_path(), reach);
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (!fields[i].mesh.empty())
            for (const std::string& warning : meshes[i].warnings)
                warnings.push_back(scene.string() + ": " + fields[i].mesh + ": " + warning);
        try {
            const std::string warning = hair::groom::bodyWarning(hair::groom::bodyMesh(meshes[i]));
            if (!warning.empty())
                warnings.push_back(scene.string() + ": " + pointerTo(i) + ": " + warning);
        } catch (const engine::Error& error) {
            refuse(i, error.what());
        }
    }
    return warnings;
}

void checkMeshes(const hair::RenderSettings& render, const std::filesystem::path& scene) {
    for (std::size_t i = 0; i < render.meshes.size(); ++i) {
        if (render.meshes[i].file.empty())
            throw engine::Error(
                scene.string(), "/render/meshes/" + std::to_string(i) +
                                    "/file: is empty; expected the name of a mesh file");
    }
}

// Mixes the base colour of the material named `scalp`: the share `own` of its own colour, and the
// rest from the other material with the most triangles.
void tintScalp(hair::groom::Mesh& mesh, const std::string& scalp, float own) {
    if (own == 1.0f) return;
    const auto named = [&](const hair::groom::Material& material) {
        return material.name == scalp;
    };
    // An importer may add materials that no triangle has.
    std::vector<std::size_t> triangles(mesh.materials.size(), 0);
    for (const std::uint32_t material : mesh.triangle_materials)
        if (!named(mesh.materials[material])) ++triangles[material];
    const auto most = std::ranges::max_element(triangles);
    if (most == triangles.end() || *most == 0) return;
    const glm::vec3 around =
        mesh.materials[static_cast<std::size_t>(most - triangles.begin())].base_color;
    for (hair::groom::Material& material : mesh.materials)
        if (named(material)) material.base_color = glm::mix(around, material.base_color, own);
}

// Returns a check of the files that `owner` names.
hair::groom::NamedFileCheck checkOf(const Reach& reach, const std::filesystem::path& owner) {
    return {
        [&reach, owner](const std::filesystem::path& file) { reach.check(file, owner); },
        reach.folders(owner)};
}

hair::groom::Mesh
meshOf(const std::filesystem::path& path, hair::groom::Textures textures, const Reach& reach) {
    return hair::groom::importMesh(path, textures, checkOf(reach, path));
}

}  // namespace

std::optional<hair::groom::Mesh> loadMesh(
    const hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach) {
    const hair::GroomSettings& groom = settings.groom;
    const std::string& file = groom.file.empty() ? groom.grow.mesh : groom.mesh;
    if (file.empty()) return std::nullopt;
    hair::groom::Mesh mesh = meshOf(
        directory / file,
        settings.render.head ? hair::groom::Textures::decoded : hair::groom::Textures::skipped,
        reach);
    tintScalp(mesh, groom.grow.scalp, settings.render.scalp_tint);
    return mesh;
}

namespace {

// ---- Keys of the store --------------------------------------------------------------------------

// Identifies a version of a file: its name, size and modification time.
std::string stampOf(const std::filesystem::path& directory, const std::string& file) {
    if (file.empty()) return "-\n";
    const std::filesystem::path path = directory / file;
    std::error_code none;
    const auto size = std::filesystem::file_size(path, none);
    const auto time = std::filesystem::last_write_time(path, none);
    return path.string() + ' ' + std::to_string(size) + ' ' +
           std::to_string(time.time_since_epoch().count()) + '\n';
}

const std::string& meshFile(const hair::GroomSettings& groom) {
    return groom.file.empty() ? groom.grow.mesh : groom.mesh;
}

std::string meshKey(const hair::Settings& settings, const std::filesystem::path& directory) {
    const float tint = settings.render.scalp_tint;
    return (settings.render.head ? "textures of " : "") +
           (tint == 1.0f ? "" : settings.groom.grow.scalp + ' ' + std::to_string(tint) + ' ') +
           stampOf(directory, meshFile(settings.groom));
}

std::string groomKey(const hair::Settings& settings, const std::filesystem::path& directory) {
    const hair::GroomSettings& groom = settings.groom;
    std::string key = directory.string() + '\n' + writeFields(groom).dump() + '\n' +
                      std::to_string(settings.seed) + '\n' + meshKey(settings, directory);
    for (const std::string& file :
         {groom.file, groom.grow.scalp, groom.grow.mask, groom.grow.length_map, groom.fixed,
          groom.cache.file})
        key += stampOf(directory, file);
    return key;
}

template <class Value>
std::size_t bytesOf(const std::vector<Value>& values) {
    return values.size() * sizeof(Value);
}

std::size_t bytesOf(const hair::groom::Mesh& mesh) {
    std::size_t bytes = bytesOf(mesh.positions) + bytesOf(mesh.normals) + bytesOf(mesh.triangles);
    for (const engine::Pixels& picture : mesh.pictures) bytes += bytesOf(picture.rgba);
    return bytes;
}

}  // namespace

const std::optional<hair::groom::Mesh>& AssetStore::mesh(
    const hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach) {
    const std::string key = meshKey(settings, directory);
    if (const auto* known = meshes_.find(key)) return *known;
    std::optional<hair::groom::Mesh> mesh = loadMesh(settings, directory, reach);
    const std::size_t bytes = mesh ? bytesOf(*mesh) : 0;
    return meshes_.add(key, std::move(mesh), bytes);
}

const hair::groom::Groom& AssetStore::groom(
    const hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach) {
    const hair::GroomSettings& groom = settings.groom;
    const std::string key = groomKey(settings, directory);
    if (const auto* known = grooms_.find(key)) return *known;
    const std::optional<hair::groom::Mesh>& grown_on = mesh(settings, directory, reach);
    hair::groom::Groom made = hair::groom::buildGroom(
        groom, grown_on ? &*grown_on : nullptr, directory, settings.seed,
        checkOf(reach, directory / (groom.file.empty() ? groom.fixed : groom.file)));
    const std::size_t bytes = bytesOf(made.points) + bytesOf(made.widths) +
                              bytesOf(made.root_triangles) + bytesOf(made.bindings) +
                              bytesOf(made.bound_ends) + bytesOf(made.bound_points) +
                              bytesOf(made.cache.points);
    return grooms_.add(key, std::move(made), bytes);
}

const std::optional<hair::groom::Mesh>*
AssetStore::knownMesh(const hair::Settings& settings, const std::filesystem::path& directory) {
    return meshes_.find(meshKey(settings, directory));
}

const hair::groom::Groom*
AssetStore::knownGroom(const hair::Settings& settings, const std::filesystem::path& directory) {
    return grooms_.find(groomKey(settings, directory));
}

void AssetStore::trim() {
    meshes_.trim();
    grooms_.trim();
}

std::vector<hair::groom::Mesh> loadFieldMeshes(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory, const Reach& reach) {
    std::vector<hair::groom::Mesh> meshes;
    for (const hair::DistanceFieldSettings& field : settings.simulation.distance_fields)
        meshes.push_back(
            field.mesh.empty()
                ? grown_on.value()
                : meshOf(directory / field.mesh, hair::groom::Textures::skipped, reach));
    return meshes;
}

std::unique_ptr<hair::groom::DeformingMesh> loadDeforming(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory, const Reach& reach) {
    const hair::AnimationSettings& animation = settings.simulation.animation;
    if (animation.clip.empty()) return nullptr;
    if (!grown_on)
        throw engine::Error(
            "/simulation/animation/clip",
            "is set, but neither /groom/mesh nor /groom/grow names a mesh");
    const std::filesystem::path file = directory / meshFile(settings.groom);
    hair::groom::MeshAnimation played(file, animation.clip, checkOf(reach, file));
    try {
        return std::make_unique<hair::groom::DeformingMesh>(
            *grown_on, std::move(played), animation);
    } catch (const engine::Error& error) {
        throw engine::Error(file.string(), error.what());
    }
}

std::optional<hair::groom::StrandSet> loadOffsets(
    const hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach) {
    if (settings.strands.offsets.empty()) return std::nullopt;
    const std::filesystem::path file = directory / settings.strands.offsets;
    return hair::groom::importStrands(file, 0, checkOf(reach, file));
}

namespace {

// Returns a file's strands where they are at its end.
hair::groom::StrandSet
lastOf(const std::filesystem::path& file, const hair::groom::NamedFileCheck& check) {
    hair::groom::StrandSet strands = hair::groom::importStrands(file, 0, check);
    if (!hair::groom::strandImporterOf(file).read_samples) return strands;
    const hair::groom::StrandSamples samples = hair::groom::importStrandSamples(file, check);
    if (samples.times.size() < 2 || samples.ends != strands.ends) return strands;
    strands.points.assign(
        samples.points.end() - static_cast<std::ptrdiff_t>(samples.ends.back()),
        samples.points.end());
    strands.metres_per_unit = samples.metres_per_unit;
    return strands;
}

}  // namespace

std::optional<hair::groom::StrandSet> loadProbeReference(
    const hair::Settings& settings, const hair::groom::Groom& groom,
    const std::filesystem::path& directory, const Reach& reach) {
    const std::string& name = settings.run.probes.reference;
    if (name.empty()) return std::nullopt;
    const std::filesystem::path file = directory / name;
    hair::groom::StrandSet strands = lastOf(file, checkOf(reach, file));
    const auto refuse = [&](const std::string& what) {
        throw engine::Error("/run/probes/reference", name + " has " + what);
    };
    if (strands.strandCount() != groom.strand_count)
        refuse(
            std::to_string(strands.strandCount()) + " strands, and there are " +
            std::to_string(groom.strand_count) + " guides");
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        if (strands.strand(i).size() != groom.strand(i).size())
            refuse(
                std::to_string(strands.strand(i).size()) + " points in strand " +
                std::to_string(i) + ", and a guide has " + std::to_string(groom.strand(i).size()));
    const auto scale = static_cast<float>(strands.metres_per_unit.value_or(1.0));
    for (glm::vec3& point : strands.points) point *= scale;
    return strands;
}

hair::rendering::RenderAssets loadRenderAssets(
    const hair::Settings& settings, const hair::groom::Mesh* head,
    const std::filesystem::path& directory, const Reach& reach) {
    hair::rendering::RenderAssets assets{.head = head};
    for (const hair::MeshSettings& mesh : settings.render.meshes)
        assets.meshes.push_back(
            meshOf(directory / mesh.file, hair::groom::Textures::decoded, reach));
    if (settings.render.overlays.bodies) {
        const auto grown_on = head ? std::optional(*head) : std::nullopt;
        assets.field_meshes = loadFieldMeshes(settings, grown_on, directory, reach);
    }
    if (!settings.strands.texture.empty())
        assets.strand_texture = engine::readImage(directory / settings.strands.texture);
    if (!settings.render.environment.empty())
        assets.environment = engine::readFloatImage(directory / settings.render.environment);
    return assets;
}

namespace {

// Returns a warning about animations of the mesh under the hair that are not played; empty if there
// are none.
std::string unplayedAnimations(
    const hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach) {
    const std::string& file = meshFile(settings.groom);
    if (file.empty() || !settings.simulation.animation.clip.empty()) return {};
    std::string names;
    try {
        for (const std::string& name :
             hair::groom::animationNames(directory / file, checkOf(reach, directory / file)))
            names.append(names.empty() ? "'" : ", '").append(name + '\'');
    } catch (const engine::Error&) {
        return {};  // a file with only skins or animations, which is no fault here
    }
    if (names.empty()) return {};
    return "/simulation/animation/clip: is empty, so nothing plays the animations of " + file +
           ": " + names;
}

// Returns a warning that bodies do not follow the deformation of a mesh; empty if they need not.
std::string stiffBodies(const hair::Settings& settings) {
    if (settings.simulation.animation.clip.empty()) return {};
    const auto& fields = settings.simulation.distance_fields;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].follows == hair::Follows::head)
            return "/simulation/distance_fields/" + std::to_string(i) +
                   ": keeps its shape and moves with the scalp's mean motion: hair does not feel "
                   "how /simulation/animation deforms the mesh";
    return {};
}

}  // namespace

std::vector<std::string>
checkAssets(const hair::Settings& settings, const std::filesystem::path& scene) {
    AssetStore assets;
    return checkAssets(settings, scene, assets);
}

std::vector<std::string> checkAssets(
    const hair::Settings& settings, const std::filesystem::path& scene, AssetStore& assets,
    const Reach& reach) {
    const std::filesystem::path directory = scene.parent_path();
    assets.trim();
    const std::optional<hair::groom::Mesh>& mesh = assets.mesh(settings, directory, reach);
    const hair::groom::Groom& groom = assets.groom(settings, directory, reach);
    std::vector<std::string> warnings = checkFields(settings, mesh, scene, reach);
    if (mesh)
        for (const std::string& warning : mesh->warnings)
            warnings.push_back(
                scene.string() + ": " +
                (settings.groom.file.empty() ? settings.groom.grow.mesh : settings.groom.mesh) +
                ": " + warning);
    checkMeshes(settings.render, scene);
    loadRenderAssets(settings, mesh ? &*mesh : nullptr, directory, reach);
    loadDeforming(settings, mesh, directory, reach);
    if (const std::string warning = unplayedAnimations(settings, directory, reach);
        !warning.empty())
        warnings.push_back(scene.string() + ": " + warning);
    if (const std::string warning = stiffBodies(settings); !warning.empty())
        warnings.push_back(scene.string() + ": " + warning);
    const std::optional<hair::groom::StrandSet> offsets = loadOffsets(settings, directory, reach);
    try {
        hair::rendering::checkStrands(settings.strands, groom);
        if (hair::rendering::hasOffsets(settings.strands))
            hair::rendering::makeStrandOffsets(
                settings.strands, groom, offsets ? &*offsets : nullptr, settings.seed);
        checkExtensions(settings);
        loadProbeReference(settings, groom, directory, reach);
    } catch (const engine::Error& error) {
        throw engine::Error(scene.string(), error.what());
    }
    return warnings;
}

}  // namespace benchmarks::scene
