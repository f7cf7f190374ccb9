#version 460
// Stores a light's map that raster.comp has drawn in its part of the images that shading reads. One
// work group per row of texels.
#extension GL_GOOGLE_include_directive : require
#include "common/picture.glsl"
#include "common/vectors.glsl"
#include "shared/options.h"
#include "shared/shadow_structs.h"

layout(local_size_x_id = kGroupConstant) in;

layout(push_constant, scalar) uniform Push { ShadowRasterPush push; };
layout(binding = 0, r32f) uniform writeonly image2D hair_depths;
layout(binding = 1, rgba32f) uniform writeonly image2D hair_layers;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ShadowMapReference { ShadowMap map; };
layout(buffer_reference, scalar) readonly buffer Words { uint at[]; };

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    ivec2 corner = ivec2(ShadowMapReference(picture.shadows).map.corner);
    uint row = gl_WorkGroupID.x;
    for (uint column = gl_LocalInvocationID.x; column < push.width; column += gl_WorkGroupSize.x) {
        uint at = row * push.width + column;
        ivec2 place = corner + ivec2(column, row);
        float nearest = uintBitsToFloat(Words(push.depths).at[at]);
        imageStore(hair_depths, place, vec4(nearest));
        vec4 sums = kCoverageUnit * vec4(floatBitsToUint(loadVector(push.layers, at)));
        sums.y += sums.x;
        sums.z += sums.y;
        sums.w += sums.z;
        imageStore(hair_layers, place, sums);
    }
}
