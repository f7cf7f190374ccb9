#ifndef HAIRBENCH_PIXEL_SAMPLES_GLSL
#define HAIRBENCH_PIXEL_SAMPLES_GLSL

#include "shared/options.h"

layout(constant_id = kPixelSamplesConstant) const uint kSamples = 1;  // of a rendered pixel

#endif
