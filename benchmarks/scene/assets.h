#pragma once

#include <cstddef>
#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/scene/extensions.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/render_assets.h"
#include "hair/settings.h"

namespace benchmarks::scene {

// An LRU cache: values by key.
template <class Value>
class LruCache {
public:
    // `most_bytes` limits the size of all values together, but the last value is always kept.
    explicit LruCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    // Returns null if the key is absent. Valid until trim().
    const Value* find(std::string_view key) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
            if (entry->key != key) continue;
            entries_.splice(entries_.begin(), entries_, entry);
            return &entries_.front().value;
        }
        return nullptr;
    }

    // `bytes` is the approximate size of the value. The key must be new.
    const Value& add(std::string key, Value value, std::size_t bytes) {
        entries_.push_front({std::move(key), std::move(value), bytes});
        bytes_ += bytes;
        return entries_.front().value;
    }

    // Removes the least recently used values above the limit.
    void trim() {
        while (bytes_ > most_bytes_ && entries_.size() > 1) {
            bytes_ -= entries_.back().bytes;
            entries_.pop_back();
        }
    }

private:
    struct Entry {
        std::string key;
        Value value;
        std::size_t bytes;
    };

    std::size_t most_bytes_;
    std::size_t bytes_ = 0;
    std::list<Entry> entries_;  // most recently used first
};

// Loads a case's files, before there is a device. File names in the settings are relative to
// `directory`; errors begin with the path of the file. `reach` checks files that the loaded files
// name themselves, such as the buffers of a .gltf.

// Loads the mesh that the hair grows on and that is drawn under it. Returns nothing if hair comes
// from a file and the settings name no mesh for it.
std::optional<hair::groom::Mesh> loadMesh(
    const hair::Settings& settings, const std::filesystem::path& directory,
    const Reach& reach = {});

// Meshes and grooms. Each is made once, as long as its files do not change. Files that those files
// name (the buffers of a .gltf) are not watched.
class AssetStore {
public:
    // Results of loadMesh() and of buildGroom() on it. Valid until trim().
    const std::optional<hair::groom::Mesh>& mesh(
        const hair::Settings& settings, const std::filesystem::path& directory,
        const Reach& reach = {});
    const hair::groom::Groom& groom(
        const hair::Settings& settings, const std::filesystem::path& directory,
        const Reach& reach = {});

    // Return the loaded mesh or groom if it is in the store, otherwise null.
    const std::optional<hair::groom::Mesh>*
    knownMesh(const hair::Settings& settings, const std::filesystem::path& directory);
    const hair::groom::Groom*
    knownGroom(const hair::Settings& settings, const std::filesystem::path& directory);

    // Removes the least recently used entries above the memory limit.
    void trim();

private:
    static constexpr std::size_t kMostMeshes = std::size_t{256} << 20;  // B
    static constexpr std::size_t kMostGrooms = std::size_t{512} << 20;  // B

    LruCache<std::optional<hair::groom::Mesh>> meshes_{kMostMeshes};
    LruCache<hair::groom::Groom> grooms_{kMostGrooms};
};

// Loads the meshes of /simulation/distance_fields, in their order. `grown_on` is from loadMesh().
std::vector<hair::groom::Mesh> loadFieldMeshes(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory, const Reach& reach = {});

// Returns the mesh from loadMesh() as /simulation/animation deforms it; null if that names no clip.
// Also throws engine::Error if there is no mesh.
std::unique_ptr<hair::groom::DeformingMesh> loadDeforming(
    const hair::Settings& settings, const std::optional<hair::groom::Mesh>& grown_on,
    const std::filesystem::path& directory, const Reach& reach = {});

// Loads the strands of /strands/offsets; nothing if it is empty.
std::optional<hair::groom::StrandSet> loadOffsets(
    const hair::Settings& settings, const std::filesystem::path& directory,
    const Reach& reach = {});

// Loads the strands of /run/probes/reference, in metres, where they are at the file's end; nothing
// if it is empty. Throws engine::Error also if they are not as many as the guides, with as many
// points.
std::optional<hair::groom::StrandSet> loadProbeReference(
    const hair::Settings& settings, const hair::groom::Groom& groom,
    const std::filesystem::path& directory, const Reach& reach = {});

// Loads everything else in the picture besides the hair. `head` is from loadMesh(), or null.
hair::rendering::RenderAssets loadRenderAssets(
    const hair::Settings& settings, const hair::groom::Mesh* head,
    const std::filesystem::path& directory, const Reach& reach = {});

// Loads and checks everything that a case of this scene needs, without a device, so that errors in
// assets show before anything runs. If the scene uses a file wrongly, the error is "<scene>: <JSON
// pointer>: <reason>". Keeps what it loads in `assets`. Returns warnings in the same form about
// assets that are odd but usable.
std::vector<std::string> checkAssets(
    const hair::Settings& settings, const std::filesystem::path& scene, AssetStore& assets,
    const Reach& reach = {});
std::vector<std::string>
checkAssets(const hair::Settings& settings, const std::filesystem::path& scene);

}  // namespace benchmarks::scene
