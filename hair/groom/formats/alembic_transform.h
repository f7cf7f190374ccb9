#pragma once

#include <optional>

#include "hair/groom/formats/alembic_values.h"
#include "hair/groom/formats/curves.h"

// Transforms of objects in an Alembic archive (AbcGeom_Xform_v3).
namespace hair::groom {

struct AlembicTransform {
    AffineSpace space;  // of the objects below
    std::optional<AlembicProperty> numbers;  // of the operations, which may move
};

// Returns the first sample of a transform's operations, from the last to the first, in the space
// above it. Throws engine::Error for an unknown operation, a rotation about no axis and a
// projection.
AlembicTransform alembicTransformOf(
    AlembicValues& values, const AlembicCompound& transform, const AffineSpace& above);

}  // namespace hair::groom
