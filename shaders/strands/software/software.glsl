// What the stages of the back end `software` share: strands as points in memory, and a buffer of
// what each sample of the picture shows.
#ifndef HAIRBENCH_SOFTWARE_GLSL
#define HAIRBENCH_SOFTWARE_GLSL

#include "common/picture.glsl"
#include "shared/software_structs.h"
#include "strands/options.glsl"
#include "strands/pixel_samples.glsl"

layout(constant_id = kMostSegmentsConstant) const uint kSegments = 1;  // of a guide
layout(constant_id = kMostPiecesConstant) const uint kMostPieces = 1;  // of a segment
layout(constant_id = kStrandBlockConstant) const uint kBlock = 1;  // strands of an invocation

layout(push_constant, scalar) uniform Push { SoftwarePush push; };

layout(buffer_reference, scalar) buffer StrandPieces { uint at[]; };
layout(buffer_reference, scalar) buffer LargePieces { uint at[]; };
layout(buffer_reference, scalar) buffer Bounds { HairBounds bounds; };

// Where the width starts anew in each guide segment, the points between two segments are there
// twice.
const uint kSplitJoints = kTaper == kTaperSegment ? 1u : 0u;
const uint kPointsPerStrand =
    kSplitJoints == 1u ? kSegments * (kMostPieces + 1u) : kSegments * kMostPieces + 1u;
const uint kPiecesPerStrand = kSegments * kMostPieces;

// The first point of a strand's piece, of which `pieces` are drawn a segment.
uint firstPoint(uint strand, uint piece, uint pieces) {
    return strand * kPointsPerStrand + piece + (kSplitJoints == 1u ? piece / pieces : 0u);
}

uint sampleIndex(uvec2 pixel, uint index) {
    return (pixel.y * push.width + pixel.x) * kSamples + index;
}

#endif
