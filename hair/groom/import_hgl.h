#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "hair/groom/groom.h"

// The thesis's guide file. Little-endian, nothing between the parts:
//   int32 strands, int32 segments, int32 triangles
//   float32 points[strands][segments + 1][3]    m, root first
//   int32 root_triangles[triangles][3]          guide indices
namespace hair {

// Refuses whatever is not exactly such a file: no strands, segments outside [1, 255], a size that
// the counts don't give (looked at before anything is allocated), a point that is not finite, a
// triangle that names a guide twice or one that isn't there.
// Throws engine::Error "path: byte N: reason".
Groom importHgl(const std::filesystem::path& path);

// The same for a file in memory; the errors begin with "byte N".
Groom parseHgl(std::span<const std::byte> bytes);

}  // namespace hair
