#version 460
// Measures the arithmetic rate of compute shaders.
#extension GL_GOOGLE_include_directive : require
#include "limits/arithmetic.glsl"

layout(local_size_x = kLimitGroup) in;

layout(buffer_reference, scalar) writeonly buffer Results { float at[]; };

void main() {
    float result = chains(float(gl_LocalInvocationID.x) / float(kLimitGroup));
    if (result == push.never) Results(push.results).at[0] = result;
}
