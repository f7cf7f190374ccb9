#pragma once

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// The curves of an Alembic archive (Ogawa; AbcGeom_Curve_v2), in its world's space and its order.
// Alembic has no unit and no up axis; hairbench's own archives state the unit.
//   P, nVertices   of every object with curves; several are joined, each placed by the transforms
//                  (AbcGeom_Xform_v3) above it
//   curveBasisAndType   linear or cubic curves; without it linear ones
//   width          diameters; groom_width takes precedence
//   and the members of .arbGeomParams in Epic's "Using Alembic for Grooms" (version 1.5):
//   groom_root_uv (else uv, one for each curve), groom_group_id, groom_guide, groom_color;
//   groom_group_name, where there is no number: 0 for the first name, and so on.
//   groom_width, groom_group_id and groom_guide may also belong to the transforms above.
// A parameter has one value, one for each curve, or one for each vertex. The number of values
// decides, whatever the parameter's scope. It may have indices.
namespace hair::groom {

// Reads the first sample of moving data, with a warning. Cubic curves are sampled like those of
// USD: evenly in t, by the fewest points that give no curve fewer points than vertices. Bézier and
// B-spline curves are those of their vertices. Catmull-Rom curves run through all of their
// vertices, as Blender draws them. They run between the second vertex and the last but one only if
// each curve begins and ends with two vertices in one place, as RenderMan requires. Curves with
// knots, of any order to
// 16, follow their knots. Parameters that only some of the objects have are left out with a
// warning; objects without the guide parameter are no guides. Refuses archives that AlembicArchive
// refuses; closed curves, other bases (Hermite, power), weights that differ; counts that don't
// fit, values of other types, numbers that are not finite; projections. Throws
// engine::Error "byte N: path of the object or property: reason".
StrandSet importAlembic(const StrandFile& file);

// The strands of importAlembic() at all samples. All that moves must have samples at the same
// times.
StrandSamples importAlembicCache(const StrandFile& file);

}  // namespace hair::groom
