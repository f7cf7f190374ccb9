#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/strand_settings.h"

// Residuals: the differences of a file's strands from the curves of their guides' mean. With them,
// the strands drawn at rest are those of the file.
namespace hair::rendering {

// The residual of one strand: samples, one for each point of the file.
struct StrandResidual {
    std::uint32_t first = 0;  // index into StrandResiduals::samples
    std::uint32_t count = 0;  // at least 2
    float step = 0.0f;  // m, unit of a sample's integers
    float reach = 0.0f;  // m: no vector of the curve through the samples is longer
};

// Lengths of vectors from the points of a file to other points, m.
struct Lengths {
    double mean = 0.0;
    double greatest = 0.0;
};

// The residuals of strands. A sample is four integers of 16 bits: a vector in steps, in the axes of
// the groom at rest, and its place along the strand, 0 at the root and 65,535 at the tip. A point
// is left out if its place is taken. Rounding moves a point by up to half a step along each axis,
// 2.7e-5 of the strand's greatest residual, and along the strand by 1/131,070 of its length.
struct StrandResiduals {
    std::vector<StrandResidual> strands;  // in the requested order
    // Layout of shaders/strands/residuals.glsl. The first is {h, 0}: h steps of bisection find a
    // place among a strand's samples; 0 if the samples of all strands are evenly spaced. The
    // samples follow, strand after strand.
    std::vector<glm::uvec2> samples;
    Lengths kept;  // of all residuals
    Lengths left;  // from the drawn curve to the points of the file, without rounding of floats
};

// Returns the residuals of the bound strands `order`, which need their points in
// groom.bound_points. Residuals are relative to the curves of the settings or, for a strand that
// follows the head alone, to its root.
StrandResiduals makeStrandResiduals(
    const groom::Groom& groom, const StrandSettings& settings,
    std::span<const std::uint32_t> order);

// Returns the directions along the guides at rest, [guide][vertex]: unit vectors from the previous
// vertex to the next, 0 where both are at one place.
std::vector<glm::vec3> restTangents(const groom::Groom& groom);

}  // namespace hair::rendering
