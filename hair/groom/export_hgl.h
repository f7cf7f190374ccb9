#pragma once

#include <filesystem>

#include "hair/groom/groom.h"

namespace hair {

// Writes the format of import_hgl.h; importHgl() gives the same groom back, bit for
// bit, but for root_normals, for which the format has no place.
// Throws engine::Error "path: reason" if the groom has no strands or more than the format holds, or
// if the file can't be written.
void exportHgl(const Groom& groom, const std::filesystem::path& path);

}  // namespace hair
