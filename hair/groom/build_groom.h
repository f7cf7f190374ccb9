#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/named_files.h"
#include "hair/settings.h"

// From files or growth to the guides of a scene, and from strands as files hold them to guides with
// one number of points.
namespace hair::groom {

// The guides that a scene asks for, styled and brushed: from the strands of settings.file or, if
// that is empty, grown. File names are relative to `directory`, the scene's folder. `mesh` is what
// the hair grows on: of settings.mesh for a file, where null is nothing, and of settings.grow.mesh
// for growth, which needs it. Throws engine::Error "path: reason" with the path of the file or of
// the mesh, also for what `check` throws.
Groom buildGroom(
    const GroomSettings& settings, const Mesh* mesh, const std::filesystem::path& directory,
    std::uint32_t seed, const NamedFileCheck& check = {});

// What buildGroom() would make, by the settings and the size of settings.file alone: of grown hair
// the counts, and of a file what is there if a point takes 12 bytes and a strand has
// kUncountedPoints where the settings don't say. A file that is compressed may hold more.
GroomSize expectedSize(const GroomSettings& settings, std::uint64_t file_bytes);

inline constexpr std::uint64_t kUncountedPoints = 16;

// Every strand with `vertices` >= 2 points, evenly spaced by arc length along its polyline, both
// ends kept to the bit; what its points have is interpolated with them. A strand that has so many
// already keeps them as they are. A strand of one point, or without length, stays at its place.
// Throws engine::Error if that makes 2^32 points or more.
StrandSet resample(StrandSet strands, std::uint32_t vertices);

// The same with a number of points for each strand, at least 2 or what it has.
StrandSet resample(StrandSet strands, std::span<const std::uint32_t> sizes);

// Guides of the strands, with their widths and root triangles, resampled to `vertices` points; 0:
// as many as their longest list has, 2 to 256. Takes lengths as metres.
// Throws engine::Error where there is no strand.
Groom toGroom(StrandSet strands, std::uint32_t vertices);

}  // namespace hair::groom
