// Specialization constants of everything that includes strands/strand.glsl: what is drawn and how.
#ifndef HAIRBENCH_STRAND_OPTIONS_GLSL
#define HAIRBENCH_STRAND_OPTIONS_GLSL

#include "shared/options.h"

layout(constant_id = kCurveConstant) const uint kCurve = kCurveBspline;
layout(constant_id = kTaperConstant) const uint kTaper = kTaperStrand;
layout(constant_id = kLodModeConstant) const uint kLodMode = kLodForced;
layout(constant_id = kSourceConstant) const uint kSource = kSourceRootTriangles;
layout(constant_id = kWidthConstant) const uint kWidth = kWidthScene;
// 1: strands are offset from their smooth shape
layout(constant_id = kOffsetsConstant) const uint kOffsets = 0;
// 1: strands of the groom have residuals
layout(constant_id = kResidualsConstant) const uint kResiduals = 0;
// 1: roots follow the triangles of a mesh that deforms
layout(constant_id = kSkinnedStrandsConstant) const uint kSkinnedStrands = 0;
layout(constant_id = kInterpolationConstant) const uint kInterpolation = kInterpolationMulti;
// 1: strands of guides that touch a body follow a single guide from the contact on
layout(constant_id = kCollisionRuleConstant) const uint kCollisionRule = 0;
layout(constant_id = kStrandCollisionConstant) const uint kStrandCollision = kStrandCollisionNone;
layout(constant_id = kRandomnessConstant) const uint kRandomness = kRandomnessHashed;
// 1: ends of pieces may lie off the curve
layout(constant_id = kLodMorphConstant) const uint kLodMorph = 0;
// 1: strands of coarser levels of detail are drawn as the hairs that they stand for
layout(constant_id = kMergedHairsConstant) const uint kMergedHairs = 0;
// 1: strands differ in colour
layout(constant_id = kOwnColorsConstant) const uint kOwnColors = 0;

// True if strands carry their words of strands/merged_word.glsl.
const bool kTellsHairs = kMergedHairs != 0 || kOwnColors != 0;

#endif
