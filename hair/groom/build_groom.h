#pragma once

#include <cstdint>
#include <filesystem>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

namespace hair {

// The guides that a scene asks for, styled: from the strands of settings.file or, if that is empty,
// grown. File names are relative to `directory`, the scene's folder. `mesh` is what the hair grows
// on: of settings.mesh for a file, where null is nothing, and of settings.grow.mesh for growth,
// which needs it. Throws engine::Error "path: reason" with the path of the file or of the mesh.
Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed);

}  // namespace hair
