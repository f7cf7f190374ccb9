#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/scene/reach.h"
#include "benchmarks/scene/recent.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

// What a case reads from files, before there is a device. `directory` is what file names in the
// settings are relative to; errors begin with the path of the file. `reach` is for files that those
// of the settings name, such as the buffers of a .gltf.
namespace benchmarks::scene {

// The mesh that the hair grows on and that is drawn under it. Absent where hair comes from a file
// and nobody says what it grows on.
std::optional<hair::groom::Mesh> loadMesh(
    const hair::Settings& settings, const std::filesystem::path& directory,
    const Reach& reach = {});

// Meshes and grooms, each made once however often it is asked for, as long as the files stay as
// they are. Files that other files name (the buffers of a .gltf) are not watched.
class AssetStore {
public:
    // As loadMesh() and buildGroom() of it. Valid until trim().
    const std::optional<hair::groom::Mesh>& mesh(
        const hair::Settings& settings, const std::filesystem::path& directory,
        const Reach& reach = {});
    const hair::groom::Groom& groom(
        const hair::Settings& settings, const std::filesystem::path& directory,
        const Reach& reach = {});

    // The same where it was made before; null where it wasn't.
    const std::optional<hair::groom::Mesh>*
    knownMesh(const hair::Settings& settings, const std::filesystem::path& directory);
    const hair::groom::Groom*
    knownGroom(const hair::Settings& settings, const std::filesystem::path& directory);

    // Lets go of what was used longest ago, if it is much.
    void trim();

private:
    static constexpr std::size_t kMostMeshes = std::size_t{256} << 20;  // B
    static constexpr std::size_t kMostGrooms = std::size_t{512} << 20;  // B

    Recent<std::optional<hair::groom::Mesh>> meshes_{kMostMeshes};
    Recent<hair::groom::Groom> grooms_{kMostGrooms};
};

// The meshes of /simulation/distance_fields, in their order. `grown_on` is what loadMesh gave.
std::vector<hair::groom::Mesh> loadFieldMeshes(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory, const Reach& reach = {});

// The mesh that loadMesh gave as /simulation/animation deforms it; null where that names no clip.
// Throws engine::Error also where there is no mesh.
std::unique_ptr<hair::groom::DeformingMesh> loadDeforming(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory);

// The strands of /strands/offsets; absent where it is empty.
std::optional<hair::groom::StrandSet> loadOffsets(
    const hair::Settings& settings, const std::filesystem::path& directory,
    const Reach& reach = {});

// What pictures show beside the hair. `head` is what loadMesh gave, or null.
hair::rendering::RenderAssets loadRenderAssets(
    const hair::Settings& settings, const hair::groom::Mesh* head,
    const std::filesystem::path& directory, const Reach& reach = {});

// Reads and checks all that a case of this scene needs, without a device: the errors of a bad asset
// before anything runs. Where the fault is in how the scene uses a file, the error is
// "<scene>: <JSON pointer>: <reason>". What it makes is left in `assets`. Returns warnings in the
// same form: what is odd and can be used.
std::vector<std::string> checkAssets(
    const hair::Settings& settings, const std::filesystem::path& scene, AssetStore& assets,
    const Reach& reach = {});
std::vector<std::string>
checkAssets(const hair::Settings& settings, const std::filesystem::path& scene);

}  // namespace benchmarks::scene
