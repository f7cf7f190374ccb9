#ifndef HAIRBENCH_PIXEL_SAMPLES_GLSL
#define HAIRBENCH_PIXEL_SAMPLES_GLSL

layout(constant_id = 15) const uint kSamples = 1;  // of a rendered pixel

#endif
