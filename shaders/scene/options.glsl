// What a mesh's material has: specialization constants.
#ifndef HAIRBENCH_SCENE_OPTIONS_GLSL
#define HAIRBENCH_SCENE_OPTIONS_GLSL

#include "shared/options.h"

layout(constant_id = kBaseColorTextureConstant) const uint kBaseColorTexture = 0;
layout(constant_id = kMetallicRoughnessTextureConstant) const uint kMetallicRoughnessTexture = 0;
layout(constant_id = kNormalTextureConstant) const uint kNormalTexture = 0;
// 1: there is no surface where it is less opaque than the cutoff
layout(constant_id = kMaskConstant) const uint kMask = 0;
layout(constant_id = kDoubleSidedConstant) const uint kDoubleSided = 0;

const bool kTextured = kBaseColorTexture + kMetallicRoughnessTexture + kNormalTexture > 0;

#endif
