#pragma once

#include <filesystem>

namespace benchmarks {

enum class Holds { strands, triangles };

// What is in a file of a format that can hold strands and meshes: OBJ, PLY, glTF. Triangles where
// it has any: an OBJ with an `f` line, a glTF with a primitive of triangles (or of no stated mode),
// a PLY with faces and without an element of strands (faces of two corners, as which assimp writes
// lines, are not told from others). Reads an OBJ up to its first face, of a PLY the header, of a
// glTF its JSON. What can't be read has triangles: its import says what is wrong.
Holds strandsOrTriangles(const std::filesystem::path& file);

}  // namespace benchmarks
