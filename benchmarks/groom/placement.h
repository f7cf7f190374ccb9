#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"

// Places files of hair and heads in a scene, which is in metres with +y up, and chooses settings of
// a scene that shows and simulates them. Guesses units and axes that files do not state by how well
// the roots fit the head.
namespace benchmarks::groom {

// ---- Placement ----------------------------------------------------------------------------------

// An axis-aligned box; without points, `low` is above `high`.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    glm::dvec3 centre() const { return 0.5 * (low + high); }
    double longestSide() const {
        const glm::dvec3 size = high - low;
        return std::max({size.x, size.y, size.z});
    }
};

Box boxOf(const std::vector<glm::vec3>& points);

// Transform from a file's coordinates to the scene's: scales, turns the upward axis to +y by a
// quarter turn, then turns about +y.
struct Lay {
    double metres_per_unit = 1.0;
    int up = 1;  // upward axis in the file: 0 x, 1 y, 2 z
    int turn = 0;  // about +y by the right-hand rule, deg: 0, 90, 180 or 270

    glm::dmat3 rotation() const;
    glm::dvec3 operator()(const glm::vec3& point) const {
        return rotation() * (metres_per_unit * glm::dvec3(point));
    }
    // Returns the angles about x, then y, then z that give rotation(), deg:
    // /groom/placement/rotation.
    glm::vec3 eulerAngles() const;
    bool changesNothing() const { return metres_per_unit == 1.0 && up == 1 && turn == 0; }
    bool operator==(const Lay&) const = default;
};

// "in cm, +z up, turned by 90 degrees".
std::string layText(const Lay& lay);

// A root within this distance, m, counts as on the head. Hair that is combed from points slightly
// off the surface still counts, but with a wrong unit or axis, roots are off by centimetres.
inline constexpr double kFitTolerance = 5e-3;

// Fit of the roots to a head.
struct RootFit {
    double share = 0.0;  // share of the roots within kFitTolerance of its surface
    double median = 0.0;  // distance from its surface, m
};

struct LayAttempt {
    Lay hair;
    Lay head;
    RootFit fit;
};

// Known facts for a guess.
struct LayHints {
    std::optional<double> metres_per_unit;  // of the hair; absent: as the file states
    std::optional<int> up;  // upward axis in the file of hair
    bool head_is_stated = false;  // the head's file states its unit and upward axis
};

struct LayGuess {
    Lay hair;
    Lay head;
    std::optional<LayAttempt> best;  // absent without a head
    std::optional<LayAttempt> runner_up;  // best attempt with another placement on the head
    bool fits = false;  // most roots are on the head; otherwise hair and head are placed separately
    // Best attempt against the file's own statement, if clearly more roots are then on the head.
    std::optional<LayAttempt> against;
    // Best attempt with the strands' last points as roots, if few roots but most of these are on
    // the head.
    std::optional<LayAttempt> reversed;
    std::vector<std::string> doubts;  // sizes and directions against statements
    std::string hair_reason;  // sentences
    std::string head_reason;  // empty without a head
};

// The upward axis by the directions in which strands leave the scalp and hang.
struct UpGuess {
    int axis;  // 0 x, 1 y, 2 z
    double lead;  // over the next axis, in lengths of the directions
};

UpGuess guessUp(const hair::groom::StrandSet& strands);

// With a smaller lead, a guess says nothing against a stated axis.
inline constexpr double kClearLead = 0.1;

const char* axisName(int axis);

// Names strays: "strand 517 (from 0), with its root 10 m from the others". Lists at most five.
std::string straysText(const std::vector<hair::groom::Stray>& strays, double metres_per_unit);

// Guesses the placement of strands, at least one, and a head in its file's coordinates, or null.
// Tries every unit among m, cm, mm and inch, every upward axis and every turn that hints and the
// file's statements leave open, and takes the attempt with the most roots on the head. Among
// attempts as good as the best (within 2 % of the roots and 0.5 mm), prefers hair on top of the
// head, then the fewest changes. Without a head, or if few roots fit it, takes the unit from
// hair::groom::inspect(), and as up the stated axis or else guessUp().
LayGuess guessLay(
    const hair::groom::StrandSet& strands, const hair::groom::Mesh* head, const LayHints& hints);

// ---- The scene ----------------------------------------------------------------------------------

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
