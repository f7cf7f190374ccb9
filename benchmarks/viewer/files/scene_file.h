#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/scene.h"
#include "hair/settings.h"

namespace benchmarks {

// A scene that is open in the viewer.
struct SceneFile {
    std::filesystem::path path;
    std::filesystem::path directory;  // what file names in it are relative to
    std::string name;
    hair::Settings settings;
};

// A scene file, or a screenshot that has one in it. No axis of its sweep is applied. Throws
// engine::Error, one line, also for a suite.
SceneFile openScene(const std::filesystem::path& path);

// What is to be done with a file that was dropped on the window: .json and PNGs with a scene in
// them, or damaged, are scenes, .exr and .hdr environments, and what strands and meshes are read
// from goes by its first bytes or its extension; strands_or_triangles.h says how formats of both
// are told apart.
enum class Dropped { scene, groom, mesh, environment, unknown };
Dropped whatIs(const std::filesystem::path& file);

// Settings with the groom (dropped_groom.h) or environment of a file in place of what was there, or
// with one more mesh beside the head. The file's name is relative to `directory` where it is below
// it, otherwise absolute. Throws engine::Error that names the file for what can't be used.
hair::Settings withDropped(
    hair::Settings settings, const std::filesystem::path& directory,
    const std::filesystem::path& file);

}  // namespace benchmarks
