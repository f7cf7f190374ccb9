#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/groom/placement.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

// Chooses settings of a scene that shows and simulates a file of hair on a head.
namespace benchmarks::groom {

// A setting or a group of them, and the reason for its value.
struct SceneChoice {
    std::string name;
    std::string reason;
};

struct GroomScene {
    hair::Settings
        settings;  // without /groom/file and /groom/mesh, which depend on the scene's folder
    // The part of the head that is the body, as a mesh of its own; absent: all of it.
    std::optional<hair::groom::Mesh> body;
    std::vector<SceneChoice> choices;
    std::vector<hair::CameraSettings> views;  // from the front, the head's left, the back, its
                                              // right
    std::vector<std::string> warnings;  // oddities with figures and advice
};

// Makes a scene from strands, at least one, and the head that they grow on, which may be null. Both
// are placed by `guess`, in metres with +y up.
GroomScene sceneOf(
    const hair::groom::StrandSet& strands, const hair::groom::Mesh* head, const LayGuess& guess);

// Return the strands in the scene's coordinates with their widths in metres, and the head likewise.
hair::groom::StrandSet placed(hair::groom::StrandSet strands, const Lay& lay);
hair::groom::Mesh placed(hair::groom::Mesh head, const Lay& lay);

// Writes the mesh as Wavefront OBJ: positions, normals, texture coordinates and triangles, without
// materials.
void writeObj(const hair::groom::Mesh& mesh, std::ostream& out);

}  // namespace benchmarks::groom
