// What a mesh's material has: specialization constants, before those of shading/options.glsl.
#ifndef HAIRBENCH_SCENE_OPTIONS_GLSL
#define HAIRBENCH_SCENE_OPTIONS_GLSL

layout(constant_id = 0) const uint kBaseColorTexture = 0;
layout(constant_id = 1) const uint kMetallicRoughnessTexture = 0;
layout(constant_id = 2) const uint kNormalTexture = 0;
layout(constant_id = 3) const uint kMask = 0;  // 1: it is not where it is less opaque than cutoff
layout(constant_id = 4) const uint kDoubleSided = 0;

const bool kTextured = kBaseColorTexture + kMetallicRoughnessTexture + kNormalTexture > 0;

#endif
