// @parameter strength 3 [-100, 100] m/s^2: along x
// @parameter swirl (0, 1, 0) [-1, 1] 1: axis
const float kTable[4] = float[4](1., 2., 3., 4.);
struct Pair { float a; vec2 b; };
void put(inout float to[4], int at) { to[at] = kTable[at & 3]; }
float[2] both(Pair p) { return float[2](p.a, p.b.y); }
vec3 accelerateGuide(GuidePoint point) {
    mat3 m = outerProduct(swirl, point.position);
    m = inverse(m) * transpose(m);
    float array[4], whole, d = determinant(m) + modf(point.time, whole);
    put(array, int(point.along * 3.0));
    int exponent;
    d = frexp(d, exponent) + array[exponent & 3] + both(Pair(d, vec2(whole)))[0];
    uint bits = bitfieldExtract(floatBitsToUint(d), 2, 3) + point.guide % 5u;
    switch (exponent) {
    case 0: d += 1.0; break;
    default: d = ldexp(d, 2);
    }
    for (int i = 0; i < 8; ++i) { if ((bits & (1u << i)) != 0u) continue; d *= kTable[i / 2]; }
    do { d = d < 1.0 ? d + guideRandom(point, bits) : sqrt(d); } while (--bits > 3u && !isnan(d));
    return mix(point.velocity, cross(swirl, point.velocity), bvec3(d > 1.0, true, false)) * strength;
}
