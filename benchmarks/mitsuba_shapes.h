#pragma once

#include <cstdint>
#include <ostream>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/strand_set.h"
#include "hair/simulation/rigid_motion.h"

// Files of geometry that Mitsuba 3 reads; lengths in m.
namespace benchmarks {

// Mitsuba's `bsplinecurve`: a line "x y z radius" for each control point, an empty line after each
// strand. The curves go through the strands' points and begin and end at them; half the widths are
// their radii. Strands of one point are left out. A radius that the spline would make negative,
// just beyond a tip that narrows to nothing, is 0 instead.
void writeMitsubaCurves(std::ostream& out, const hair::StrandSet& strands);

// PLY of the triangles with this material, where `pose` takes them, with texture coordinates where
// the mesh has them.
void writeMaterialPly(
    std::ostream& out, const hair::Mesh& mesh, std::uint32_t material,
    const hair::RigidMotion& pose);

}  // namespace benchmarks
