// How strands are lit and what becomes of their fragments: specialization constants, after those of
// strands/options.glsl.
#ifndef HAIRBENCH_SHADING_OPTIONS_GLSL
#define HAIRBENCH_SHADING_OPTIONS_GLSL

#include "shared/light_structs.h"

const uint kModelPhong = 0;
const uint kModelKajiyaKay = 1;
const uint kModelMarschner = 2;
const uint kModelDualScattering = 3;
const uint kShowTangents = 1;
const uint kShowNormals = 2;
const uint kShowLod = 3;
const uint kShowStrands = 4;

layout(constant_id = 16) const uint kModel = kModelPhong;
layout(constant_id = 17) const uint kLightCount = 1;
layout(constant_id = 18) const uint kMeshShadows = 0;     // 1: meshes throw shadows
layout(constant_id = 19) const uint kHairShadows = 0;     // 1: hair does
layout(constant_id = 20) const uint kEnvironment = 0;     // 1: light from all around
layout(constant_id = 21) const uint kLinearLight = 0;     // 1: working colours are linear
layout(constant_id = 22) const uint kAnalyticCoverage = 0;  // 1: thin strands fade
layout(constant_id = 23) const uint kStrandTexture = 0;   // 1: strands have a picture
layout(constant_id = 24) const uint kShow = 0;            // 0: what light shows
layout(constant_id = 25) const uint kLightKinds = kAllLightKinds;  // what lights there may be

#endif
