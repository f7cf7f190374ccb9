#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/mitsuba_scene.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/simulation/rigid_motion.h"

namespace benchmarks {

// Writes a mesh, where `pose` takes it, into `folder`: "<name>_0.ply" and so on, one of each
// material that has triangles, and the pictures of base colours as PNG.
std::vector<MitsubaParts::Mesh> writeMitsubaMesh(
    const std::filesystem::path& folder, const std::string& name, const hair::Mesh& mesh,
    const hair::RigidMotion& pose);

}  // namespace benchmarks
