#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// Curves of a scene of pbrt, versions 3 and 4 (Pharr, Jakob and Humphreys 2023, Physically based
// rendering, 4th edition, section 6.7, and pbrt-v4's file format):
//   Shape "curve" "string type" "cylinder" "string basis" "bezier" "integer degree" 3
//       "point3 P" [x y z ...] "float width0" 0.1 "float width1" 0.05
// The basis is bezier (the default) or bspline, uniform, of degree 3 (the default) or 2. Widths are
// diameters and change evenly with the curve's parameter; `width` is both. The format states no
// unit.
namespace hair::groom {

// Writes shapes to be named by an `Include` of a scene: each segment is a straight cubic Bézier
// segment. A strand is one shape if it has one width, otherwise a shape for each segment. Strands
// of one point are left out. Returns a sentence for all data that is left out. Throws engine::Error
// if no strand has two points.
std::vector<std::string> exportPbrt(const StrandSet& strands, std::ostream& out);

// Curves in the order of the file, placed by the transforms around them. A segment is sampled
// evenly in its parameter, by the fewest points that give no curve fewer points than vertices; a
// cubic Bézier segment with its inner vertices at its thirds is straight and has none between its
// ends. Bézier curves in successive shapes become one strand if each begins where the one before
// ends, with the same width, because some programs write only segments. The comment at the
// beginning is kept. Curves in objects (ObjectBegin) and included files are left out with a
// warning. If no curve has a width, widths are not known. Refuses other text, degrees and bases,
// numbers of vertices that make no curve, and curves after LookAt or
// CoordSysTransform. Throws engine::Error "line N: reason".
StrandSet importPbrt(const StrandFile& file);

}  // namespace hair::groom
