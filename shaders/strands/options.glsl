// What is drawn, and how: the specialization constants of all that includes strands/strand.glsl.
#ifndef HAIRBENCH_STRAND_OPTIONS_GLSL
#define HAIRBENCH_STRAND_OPTIONS_GLSL

const uint kCurveBspline = 0;
const uint kCurveBsplineUnpinned = 1;
const uint kCurveCatmullRom = 2;
const uint kTaperStrand = 0;
const uint kTaperSegment = 1;
const uint kLodForced = 0;
const uint kSourceRootTriangles = 0;
const uint kSourceGroom = 1;
const uint kInterpolationMulti = 0;
const uint kInterpolationSingle = 1;
const uint kInterpolationMixed = 2;
const uint kRandomnessHashed = 0;
const uint kRandomnessThesis = 1;
const uint kWidthScene = 0;
const uint kWidthGroom = 1;

layout(constant_id = 0) const uint kCurve = kCurveBspline;
layout(constant_id = 1) const uint kTaper = kTaperStrand;
layout(constant_id = 2) const uint kLodMode = kLodForced;
layout(constant_id = 3) const uint kSource = kSourceRootTriangles;
layout(constant_id = 4) const uint kWidth = kWidthScene;
layout(constant_id = 5) const uint kOffsets = 0;  // 1: strands are offset from their smooth shape
layout(constant_id = 6) const uint kInterpolation = kInterpolationMulti;
layout(constant_id = 7) const uint kCollisionRule = 0;  // 1: strands of guides that touch a body
                                                        // follow one of them from there on
layout(constant_id = 8) const uint kRandomness = kRandomnessHashed;
layout(constant_id = 9) const uint kLodMorph = 0;  // 1: ends of pieces may be off the curve

#endif
