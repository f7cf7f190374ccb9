#pragma once

#include <filesystem>
#include <string>

#include "hair/settings.h"

namespace benchmarks::viewer {

// Settings whose hair is that of a file, without what belonged to the hair before: its style, its
// placement and the hands that pull at it.
//   - Where the file doesn't state its unit, it is guessed as `groom info` does.
//   - Of more than 1,000 strands 300 become guides, and all are drawn, each moved by three of them.
//   - The mesh stays where the roots are on it (three quarters of them within 1 cm); otherwise it
//     goes, with the bodies that follow it, and the strands float.
// `name` is what the settings call the file; other names in them are relative to `directory`.
// Throws engine::Error that names a file.
hair::Settings withGroom(
    hair::Settings settings, const std::filesystem::path& directory,
    const std::filesystem::path& file, const std::string& name);

enum class Holds { strands, triangles };

// What is in a file of a format that can hold strands and meshes: OBJ, PLY, glTF. Triangles where
// it has any: an OBJ with an `f` line, a glTF with a primitive of triangles (or of no stated mode),
// a PLY with faces and without an element of strands (faces of two corners, as which assimp writes
// lines, are not told from others). Reads an OBJ up to its first face, of a PLY the header, of a
// glTF its JSON. What can't be read has triangles: its import says what is wrong.
Holds strandsOrTriangles(const std::filesystem::path& file);

}  // namespace benchmarks::viewer
