#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"

// How files of hair and of heads lie in a scene, which is in metres with +y up: units and axes that
// files do not state, guessed by how well the roots fit the head.
namespace benchmarks::groom {

// What takes the coordinates of a file to the scene's: scaled, the upward axis to +y by a quarter
// turn, then turned about +y.
struct Lay {
    double metres_per_unit = 1.0;
    int up = 1;  // the axis that is up in the file: 0 x, 1 y, 2 z
    int turn = 0;  // about +y by the right-hand rule, deg: 0, 90, 180 or 270

    glm::dmat3 rotation() const;
    glm::dvec3 operator()(const glm::vec3& point) const {
        return rotation() * (metres_per_unit * glm::dvec3(point));
    }
    // Angles about x, then y, then z that make rotation(), deg: /groom/placement/rotation.
    glm::vec3 eulerAngles() const;
    bool changesNothing() const { return metres_per_unit == 1.0 && up == 1 && turn == 0; }
    bool operator==(const Lay&) const = default;
};

// "in cm, +z up, turned by 90 degrees".
std::string layText(const Lay& lay);

// A root counts as on the head within this distance, m: hair that is combed from points slightly
// off the surface is still meant for it, and by another unit or axis roots are off by centimetres.
inline constexpr double kFitTolerance = 5e-3;

// Roots on a head.
struct RootFit {
    double share = 0.0;  // of the roots that are within kFitTolerance of its surface
    double median = 0.0;  // distance from it, m
};

struct LayAttempt {
    Lay hair;
    Lay head;
    RootFit fit;
};

// What is known before a guess.
struct LayHints {
    std::optional<double>
        metres_per_unit;  // of the hair; where absent, what the file states counts
    std::optional<int> up;  // axis that is up in the file of hair
    bool head_is_stated = false;  // the head's format states metres and +y up
};

struct LayGuess {
    Lay hair;
    Lay head;
    std::optional<LayAttempt> best;  // absent: there is no head
    std::optional<LayAttempt> runner_up;  // the best that places the hair otherwise on the head
    bool fits = false;  // most roots are on the head; else hair and head are placed each by itself
    std::string hair_reason;  // sentences
    std::string head_reason;  // empty: there is no head
};

// The guess for these strands, at least one, and the head, as its file has it or null: of every
// unit among m, cm, mm and inch, axis that is up and turn that the hints leave open the one with
// the most roots on the head. Of those that are as good as the best (2 % of the roots and 0.5 mm)
// it takes one that has the hair on top of the head, and then the one that changes the least.
// Without a head, and where few roots fit it, the unit is hair::groom::inspect()'s, and up is where
// strands leave the scalp to and what they hang down from.
LayGuess guessLay(
    const hair::groom::StrandSet& strands, const hair::groom::Mesh* head, const LayHints& hints);

}  // namespace benchmarks::groom
