#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "benchmarks/report/environment.h"
#include "benchmarks/scene/assets.h"
#include "engine/device.h"
#include "engine/system/files.h"
#include "engine/system/machine.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/simulation.h"

// Cache on disk for data that takes long to make, kept between runs.

namespace benchmarks::measure {

struct DiskCacheOptions {
    // Created at the first store; empty: nothing is kept.
    std::filesystem::path folder;
    std::uint64_t most_bytes = std::uint64_t{1} << 30;  // sum over all entries
    // Called with a message for each unusable entry; may be empty.
    std::function<void(const std::string&)> warn{};
};

// $XDG_CACHE_HOME/hairbench/hair, or the same in ~/.cache; empty without a home directory.
std::filesystem::path hairCacheFolder();

// Keeps one file per entry. The file's name is a hash of the key; the file holds the whole key and
// a hash of the bytes, so damaged, truncated and foreign entries are rejected. Processes may share
// a folder: files are written under another name and then renamed. The least recently used entries
// are removed first. A failed write is not an error; the entry is just not kept.
class DiskCache {
public:
    explicit DiskCache(DiskCacheOptions options) : options_(std::move(options)) {}

    bool isOn() const { return !options_.folder.empty(); }

    // Absent if the entry is missing or unusable; unusable entries are reported to `warn`.
    std::optional<std::string> load(const std::string& key) const;

    // True if an entry of this size is kept: at most a quarter of most_bytes.
    bool takes(std::size_t bytes) const { return isOn() && bytes <= options_.most_bytes / 4; }
    void store(const std::string& key, const std::string& bytes) const;

    // Path of an entry's file.
    std::filesystem::path fileOf(const std::string& key) const;

    // Reports that an entry's bytes are invalid.
    void warn(const std::string& key, const std::string& reason) const;

private:
    DiskCacheOptions options_;
};

// Data that cases share.

// Data that is common to cases that differ only in drawing, made once: mesh, groom, and the
// simulations' baked distance fields and settled states. The last two are also kept on disk. All
// data is on the host. Each case owns its objects on the device, and results are identical to the
// bit with and without the cache.
//
// Fields are identified by the content of their mesh. States are identified by the content of the
// groom, the fields' meshes and, with an animation, the initial head mesh. Keys of both also hold
// the relevant settings, the device with its driver and features, the processor for a software
// device, and the program. Entries on disk are used only by the same program file, so a changed
// build never uses another's. If the program file is unknown, nothing is used.
class HairCache {
public:
    // `processor` is that of software devices.
    explicit HairCache(
        DiskCache disk = DiskCache({}), std::string processor = engine::system::processorName())
        : disk_(std::move(disk)), processor_(std::move(processor)) {}

    // Meshes and grooms.
    scene::AssetStore& assets() { return assets_; }

    // Constructs a Simulation and reuses known data.
    hair::simulation::Simulation simulation(
        const engine::Device& device, const hair::groom::Groom& groom,
        const hair::Settings& settings, std::span<const hair::groom::Mesh> field_meshes,
        const hair::groom::DeformingMesh* deforming = nullptr);

    // Number of fields baked and states settled because they were not in the cache.
    std::size_t made() const { return made_; }

private:
    static constexpr std::size_t kMostFields = std::size_t{256} << 20;  // B
    static constexpr std::size_t kMostStates = std::size_t{512} << 20;  // B

    template <class Value>
    void keep(const std::string& key, Value value, scene::LruCache<Value>& values);
    const hair::simulation::BakedField* field(const std::string& key);
    const hair::simulation::SettledState* settled(const std::string& key);
    // Identifies the program's file, if entries outlive the process, and its replaced shaders.
    std::string program(const engine::Device& device);

    DiskCache disk_;
    std::string processor_;
    scene::AssetStore assets_;
    scene::LruCache<hair::simulation::BakedField> fields_{kMostFields};
    scene::LruCache<hair::simulation::SettledState> states_{kMostStates};
    std::string program_;  // hash of its file; empty: not computed
    std::size_t made_ = 0;
};

// Creates a cache in the user's folder, or in memory only. Faults of entries are printed to stderr.
HairCache userHairCache(bool on_disk);

}  // namespace benchmarks::measure
