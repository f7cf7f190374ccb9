#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string_view>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/named_files.h"

namespace hair::groom {

// A reader of mesh files. Its triangles have indices in range, its members have the sizes that
// mesh.h states, and each material has a name and a colour. Normals may be missing or zero. Its
// errors don't name the file.
struct MeshImporter {
    std::span<const std::string_view> extensions;  // lower case, with the dot
    Mesh (*import)(
        const std::filesystem::path& path, Textures textures, const NamedFileCheck& check);
};

// A new format is a row here.
std::span<const MeshImporter> meshImporters();

// Reads a mesh in the format of its extension, in upper or lower case. The mesh has at least one
// triangle, finite positions and texture coordinates, weights from 0 to 1, and unit normals.
// Lengths are in the file's unit; files that state their unit (glTF, FBX, COLLADA, USD with
// metersPerUnit) come out in metres. Throws engine::Error "path: reason", also for errors that
// `check` throws.
Mesh importMesh(
    const std::filesystem::path& path, Textures textures = Textures::skipped,
    const NamedFileCheck& check = {});

}  // namespace hair::groom
