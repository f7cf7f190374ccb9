// How strands are lit and how their fragments are used, as specialization constants.
#ifndef HAIRBENCH_SHADING_OPTIONS_GLSL
#define HAIRBENCH_SHADING_OPTIONS_GLSL

#include "shared/light_structs.h"
#include "shared/options.h"

layout(constant_id = kModelConstant) const uint kModel = kModelPhong;
layout(constant_id = kLightCountConstant) const uint kLightCount = 1;
layout(constant_id = kMeshShadowsConstant) const uint kMeshShadows = 0;  // 1: meshes throw shadows
layout(constant_id = kHairShadowsConstant) const uint kHairShadows = kHairShadowsNone;
layout(constant_id = kEnvironmentConstant) const uint kEnvironment = kEnvironmentNone;
// 1: working colours are linear
layout(constant_id = kLinearLightConstant) const uint kLinearLight = 0;
// 1: strands thinner than a pixel are drawn with partial coverage
layout(constant_id = kAnalyticCoverageConstant) const uint kAnalyticCoverage = 0;
// 1: strands have a texture
layout(constant_id = kStrandTextureConstant) const uint kStrandTexture = 0;
layout(constant_id = kShowConstant) const uint kShow = kShowShading;
// Kinds of lights that may occur
layout(constant_id = kLightKindsConstant) const uint kLightKinds = kAllLightKinds;
// 1: fibres show the mean over the part of their width that a pixel covers
layout(constant_id = kFarFieldConstant) const uint kFarField = 0;

// True if fragments read the width of their strand.
const bool kNeedsWidth = kAnalyticCoverage != 0u || kFarField != 0u ||
                         kHairShadows == kHairShadowsDeepShadow;

#endif
