// Culling of strands that are outside the picture.
#ifndef HAIRBENCH_OUTSIDE_GLSL
#define HAIRBENCH_OUTSIDE_GLSL

#include "common/picture.glsl"
#include "strands/patch.glsl"
#include "strands/pixel_margin.glsl"

// True if no strand between the guides can be in the picture; only the guides' vertices `first` to
// `last` affect it. Splines and interpolation stay within the guides' convex hull, with these
// exceptions: roots away from their guide's root, a segment at splines' ends and bends, the margin
// that coverage draws beside strands, and offsets and widths, which are in `beyond`, m.
bool isOutsideFrustum(PictureParameters picture, uvec3 guides, uint first, uint last,
                      float beyond) {
    mat4 rows = transpose(picture.view_projection);
    vec4 planes[5] = vec4[5](rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                             rows[3] - rows[1], rows[3] - rows[2]);
    float furthest[5] = float[5](-1e30, -1e30, -1e30, -1e30, -1e30);  // signed distances, positive
                                                                      // inside
    vec3 root = guideVertex(picture, guides.x, 0u);
    float edge = 0.0;
    float longest = 0.0;
    float margin = 0.0;
    for (int corner = 0; corner < 3; ++corner) {
        edge = max(edge, distance(root, guideVertex(picture, guides[corner], 0u)));
        vec3 before = guideVertex(picture, guides[corner], first);
        for (uint i = first; i <= last; ++i) {
            vec3 vertex = guideVertex(picture, guides[corner], i);
            longest = max(longest, distance(before, vertex));
            before = vertex;
            margin = max(margin, pixelMargin(picture, vertex));
            for (int k = 0; k < 5; ++k)
                furthest[k] = max(furthest[k], dot(planes[k], vec4(vertex, 1.0)));
        }
    }
    float reach = beyond + 2.0 * edge + longest + margin;
    for (int k = 0; k < 5; ++k)
        if (furthest[k] < -reach * length(planes[k].xyz)) return true;
    return false;
}

#endif
