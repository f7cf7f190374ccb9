#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/strand_settings.h"

// What strands of a file are off the curves that the mean of their guides gives, so that at rest
// the file's strands are what is drawn.
namespace hair::rendering {

// The residual of one strand: samples, one for each point of the file.
struct StrandResidual {
    std::uint32_t first = 0;  // of StrandResiduals::samples
    std::uint32_t count = 0;  // at least 2
    float step = 0.0f;  // m, of a sample's whole numbers
    float reach = 0.0f;  // m: no vector of the curve through the samples is longer
};

// How long the vectors are that take points of the file to something, m.
struct Lengths {
    double mean = 0.0;
    double greatest = 0.0;
};

// The residuals of strands. A sample is four numbers of 16 bits: the three of a vector in steps, in
// the axes of the groom at rest, and its place along the strand, 0 at the root and 65,535 at the
// tip. Points at the places of others are left out. Rounding moves a point by up to half of the
// step in each direction, 2.7e-5 of the strand's greatest residual, and along the strand by
// 1/131,070 of its length.
struct StrandResiduals {
    std::vector<StrandResidual> strands;  // in the order that was asked for
    // shaders/strands/residuals.glsl. First {h, 0}: so many halvings find a place among a strand's
    // samples, none where all strands' are spaced evenly. Then strand after strand.
    std::vector<glm::uvec2> samples;
    Lengths kept;  // of all residuals
    Lengths left;  // from the drawn curve to the points of the file, roundings of floats left out
};

// The residuals of the bound strands `order`, whose points groom.bound_points has to have, beside
// the curves that the settings ask for, or beside the root of a strand that follows the head alone.
StrandResiduals makeStrandResiduals(
    const groom::Groom& groom, const StrandSettings& settings,
    std::span<const std::uint32_t> order);

// Directions along the guides at rest, [guide][vertex]: unit vectors from the vertex before to the
// one after, 0 where these are at one place.
std::vector<glm::vec3> restTangents(const groom::Groom& groom);

}  // namespace hair::rendering
