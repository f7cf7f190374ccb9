#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "hair/groom/groom.h"
#include "hair/groom/mesh.h"
#include "hair/settings.h"

namespace hair {

// A reader of guide files; its errors begin with the path.
struct GroomImporter {
    std::string_view extension;  // lower case, with the dot
    Groom (*import)(const std::filesystem::path& path);
};

// A new format is a row here.
std::span<const GroomImporter> groomImporters();

// The guides that a scene asks for: read from settings.file, relative to `directory` (the scene's
// folder), or, if that is empty, grown on `mesh`, which is then needed: it is what
// settings.grow.mesh names. Throws engine::Error "path: reason" with the path of the guide file or
// of the mesh.
Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed);

}  // namespace hair
