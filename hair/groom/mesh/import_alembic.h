#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/named_files.h"

// The meshes of an Alembic archive (Ogawa; AbcGeom_PolyMesh_v1 and AbcGeom_SubD_v1, whose control
// mesh is not subdivided), in its world's space and unit. Each mesh has, in .geom:
//   P              positions of its vertices
//   .faceCounts    corners of each face
//   .faceIndices   vertices of the corners, clockwise seen from outside
//   uv             texture coordinates of each corner, or of each vertex
// Face sets (AbcGeom_FaceSet_v1) below a mesh have the numbers of their .faces.
namespace hair::groom {

// Reads the first sample of moving data. A part is a mesh; a material is a face set, or else the
// default one. Vertices are split where corners have other texture coordinates. Normals are those
// of the vertices before that; normals of the file and edges' sharpness are not read. Hidden meshes
// are counted in a warning. Refuses archives that AlembicArchive refuses, counts that don't fit,
// indices out of range, numbers that are not finite, and over 16 times the file's size. Throws
// engine::Error "byte N: path: reason".
Mesh readAlembicMesh(std::span<const std::byte> bytes);

// A MeshImporter's `import`.
Mesh importAlembicMesh(
    const std::filesystem::path& path, Textures textures, const NamedFileCheck& check);

}  // namespace hair::groom
