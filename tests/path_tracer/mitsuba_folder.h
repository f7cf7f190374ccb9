#pragma once

#include <filesystem>

#include "hair/reference/path_tracer.h"

// A scene that `hairbench export SCENE --mitsuba DIR` wrote, for our own path tracer.
struct TracedFolder {
    hair::reference::TracedScene scene;
    hair::reference::TracedCamera camera;
};

// Reads scene.xml and the hair and meshes that it names. Meshes are matt with their base colours,
// glossy ones too. Throws std::runtime_error for what the tracer has not: textures, surroundings.
TracedFolder readMitsubaFolder(const std::filesystem::path& folder);
