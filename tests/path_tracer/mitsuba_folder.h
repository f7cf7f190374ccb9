#pragma once

#include <filesystem>

#include "hair/reference/path_tracer.h"

// A scene for our own path tracer, read from the files of `hairbench export SCENE --mitsuba DIR`.
struct TracedFolder {
    hair::reference::TracedScene scene;
    hair::reference::TracedCamera camera;
};

// Reads scene.xml and the hair and meshes that it names. All meshes are matt with their base
// colours, even glossy ones. Throws std::runtime_error for features that the tracer lacks: textures
// and environments.
TracedFolder readMitsubaFolder(const std::filesystem::path& folder);
