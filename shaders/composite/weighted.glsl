// Makes one fragment over the picture from the sums of strands/weighted.frag: McGuire and Bavoil
// 2013, equations (6) and following.
layout(location = 0) out vec4 color;

void blendWeighted(vec4 weighted, float revealed) {
    if (weighted.a <= 0.0) discard;
    if (isinf(weighted.a)) weighted = vec4(1.0);  // half floats overflowed: at least not black
    color = vec4(weighted.rgb / weighted.a, 1.0 - revealed);
}
