#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "benchmarks/groom/placement.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

// From a file of hair and a head to the settings of a scene that shows and simulates them.
namespace benchmarks::groom {

// A setting, or some that go together, and why they are as they are.
struct SceneChoice {
    std::string name;
    std::string reason;
};

struct GroomScene {
    hair::Settings
        settings;  // without /groom/file and /groom/mesh, which depend on the scene's place
    std::vector<SceneChoice> choices;
    std::vector<hair::CameraSettings> views;  // from the front, its left, the back, its right
    std::vector<std::string> warnings;  // what is odd, with figures, and what to do
};

// Strands, at least one, and the head that they grow on, or null, where `guess` puts them: both in
// metres with +y up.
GroomScene sceneOf(
    const hair::groom::StrandSet& strands, const hair::groom::Mesh* head, const LayGuess& guess);

// Strands in the scene's coordinates, with their widths in metres.
hair::groom::StrandSet placed(hair::groom::StrandSet strands, const Lay& lay);
hair::groom::Mesh placed(hair::groom::Mesh head, const Lay& lay);

// The mesh as Wavefront OBJ: positions, normals, texture coordinates and triangles. Its materials
// are left out.
void writeObj(const hair::groom::Mesh& mesh, std::ostream& out);

}  // namespace benchmarks::groom
