#pragma once

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// The curves of a scene of Embree's tutorials (Intel, tutorials/common/scenegraph/xml_loader.cpp):
//   <scene>
//     <Curves basis="linear" type="flat">
//       <positions>x y z radius ...</positions>
//       <indices>first vertex of each segment ...</indices>    and perhaps <curveid>
//     </Curves>
//   </scene>
// The basis is linear, bezier, bspline, catmull_rom or, with <tangents>, hermite. Older names are
// LineSegments, ConeSegments, RoundLineSegments, BSplineHair, BSplineCurves, and, with a curve's
// number beside each index, Hair, BezierHair and BezierCurves. Arrays with `ofs` and `size` are in
// the file of the same name that ends in .bin. The format states no unit.
namespace hair::groom {

// Consecutive segments make a strand. Linear segments are their vertices. Cubic segments are
// sampled like those of USD, evenly in t, by the fewest points that give no strand fewer points
// than control vertices. Widths are twice the radii. Groups, transforms (a matrix, `translate` or
// `scale`) and references (`ref`) to nodes with an `id` or in an `assign` are followed. Other
// contents of the scene, and strands with a vertex that is NaN, are left out with a warning.
// Refuses other files, other bases, transforms in other forms, indices out of range, arrays of a
// wrong length, infinite numbers and references to over 256 MB, counted as often
// as they are followed. Throws engine::Error "line N: reason".
StrandSet importEmbreeXml(const StrandFile& file);

}  // namespace hair::groom
