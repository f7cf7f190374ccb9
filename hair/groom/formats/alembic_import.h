#pragma once

#include "hair/groom/files.h"
#include "hair/groom/groom.h"

// The curves of an Alembic archive (Ogawa; AbcGeom_Curve_v2), in its world's space and its order.
// Alembic has no unit and no up axis; hairbench's own archives state the unit.
//   P, nVertices   of every object with curves; several are joined, each placed by the transforms
//                  (AbcGeom_Xform_v3) that it is under
//   curveBasisAndType   linear or cubic curves; without it linear ones
//   width          diameters; groom_width comes before it
//   and of .arbGeomParams what Epic's "Using Alembic for Grooms" (version 1.5) names:
//   groom_root_uv (else uv, one for each curve), groom_group_id, groom_guide, groom_color;
//   groom_group_name, where there is no number: 0 for the first name, and so on.
//   groom_width, groom_group_id and groom_guide may also be of the transforms above.
// A parameter has one value, one for each curve, or one for each vertex: how many there are says
// which, whatever its scope. It may have indices.
namespace hair::groom {

// Of what moves the first sample is read, with a warning. Cubic curves are sampled as those of USD
// are: evenly in t, by the fewest points that give no curve fewer than it has vertices. Bézier and
// B-spline curves are those of their vertices; Catmull-Rom curves run through all of theirs, as
// Blender draws them, but where each has its two first and two last vertices in one place, as
// RenderMan wants them, between those. Curves with knots, of any order to 16, are what these say.
// What parameters only some of the objects have is left out with a warning; of guides those are
// none that say nothing. Refuses whatever is not as AlembicArchive says; closed curves, other bases
// (Hermite, power), weights that differ; counts that don't fit, values of other types, numbers that
// are not finite, negative widths; projections. Throws engine::Error
// "byte N: path of the object or property: reason".
StrandSet importAlembic(const StrandFile& file);

}  // namespace hair::groom
