#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "benchmarks/measure/disk_cache.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/recent.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/simulation.h"

// What cases have in common.
namespace benchmarks::measure {

// What cases that differ only in how they are drawn have in common, each made once: mesh and groom,
// and of their simulations the baked distance fields and the settled state, the latter two also on
// disk. All of it lies on the host: a case owns its device's objects, and they are to the bit what
// they are without the cache.
//
// Fields are known by the content of their mesh, states by that of the groom, the fields'
// meshes and where an animation has the head's mesh at first, and both by the settings that decide
// them, the device, its driver and features, on a software device the processor, and the program:
// only what the very same program file has made is taken from disk, so a changed build never takes
// another's, and where the file is not known nothing is.
class HairCache {
public:
    explicit HairCache(DiskCache disk = DiskCache({})) : disk_(std::move(disk)) {}

    // Meshes and grooms.
    scene::AssetStore& assets() { return assets_; }

    // As Simulation's constructor, which it is but for what is known.
    hair::simulation::Simulation simulation(
        const engine::Device& device, const hair::groom::Groom& groom,
        const hair::Settings& settings, std::span<const hair::groom::Mesh> field_meshes,
        const hair::groom::DeformingMesh* deforming = nullptr);

    // Fields that were baked and states that were settled for want of a known one.
    std::size_t made() const { return made_; }

private:
    static constexpr std::size_t kMostFields = std::size_t{256} << 20;  // B
    static constexpr std::size_t kMostStates = std::size_t{512} << 20;  // B

    template <class Value>
    void keep(const std::string& key, Value value, scene::Recent<Value>& values);
    const hair::simulation::BakedField* field(const std::string& key);
    const hair::simulation::SettledState* settled(const std::string& key);
    // The program's file, where entries outlive the process, and what of its shaders was replaced.
    std::string program(const engine::Device& device);

    DiskCache disk_;
    scene::AssetStore assets_;
    scene::Recent<hair::simulation::BakedField> fields_{kMostFields};
    scene::Recent<hair::simulation::SettledState> states_{kMostStates};
    std::string program_;  // hash of its file; empty: not asked for
    std::size_t made_ = 0;
};

// With the user's folder, or none on disk; faults of entries are told on stderr.
HairCache userHairCache(bool on_disk);

}  // namespace benchmarks::measure
