// Properties of a mesh's material as specialization constants.
#ifndef HAIRBENCH_SCENE_OPTIONS_GLSL
#define HAIRBENCH_SCENE_OPTIONS_GLSL

#include "shared/options.h"

layout(constant_id = kBaseColorTextureConstant) const uint kBaseColorTexture = 0;
layout(constant_id = kMetallicRoughnessTextureConstant) const uint kMetallicRoughnessTexture = 0;
layout(constant_id = kNormalTextureConstant) const uint kNormalTexture = 0;
// 1: texels with less opacity than the cutoff are discarded
layout(constant_id = kMaskConstant) const uint kMask = 0;
layout(constant_id = kDoubleSidedConstant) const uint kDoubleSided = 0;

const bool kTextured = kBaseColorTexture + kMetallicRoughnessTexture + kNormalTexture > 0;

#endif
