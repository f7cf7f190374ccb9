#pragma once

#include <filesystem>

#include "hair/groom/mesh.h"

namespace hair {

// Whatever assimp reads, with node transforms applied, polygons triangulated, points and lines left
// out.
Mesh importAssimp(const std::filesystem::path& path);

}  // namespace hair
