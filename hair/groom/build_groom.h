#pragma once

#include <cstdint>
#include <filesystem>

#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/named_files.h"
#include "hair/settings.h"

// Builds the guides of a scene from files or by growth, and makes guides with equal numbers of
// points from strands of files.
namespace hair::groom {

// Returns the guides of a scene, styled and brushed: from the strands of settings.file or, if that
// is empty, grown. File names are relative to `directory`, the scene's folder. Hair of a file grows
// on `mesh`, made from settings.mesh, or on nothing if that is null. Growth needs `mesh`, made from
// settings.grow.mesh. Throws engine::Error "path: reason" with the path of the file or of the mesh,
// also for errors that `check` throws.
Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed, const NamedFileCheck& check = {});

// Predicts the size of buildGroom()'s result from the settings and the size of settings.file alone.
// The settings give the counts of grown hair. For a file, a point is taken as 12 bytes and a strand
// as kUncountedPoints points, if the settings don't say. A compressed file may hold more.
// `cache_bytes`: of the file that plays, if one does.
GroomSize expectedSize(
    const GroomSettings& settings, std::uint64_t file_bytes, std::uint64_t cache_bytes = 0);

inline constexpr std::uint64_t kUncountedPoints = 16;

// Makes guides of the strands, with their widths and root triangles, resampled to `vertices`
// points. 0 takes the greatest number of points of a strand, clamped to [2, 256]. Lengths count as
// metres. Throws engine::Error if there is no strand.
Groom toGroom(StrandSet strands, std::uint32_t vertices);

}  // namespace hair::groom
