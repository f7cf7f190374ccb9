#ifndef HAIRBENCH_SIMULATION_ROD_SYMMETRIC_GLSL
#define HAIRBENCH_SIMULATION_ROD_SYMMETRIC_GLSL

// crossMatrix(a) b = a x b.
mat3 crossMatrix(vec3 a) { return mat3(0.0, a.z, -a.y, -a.z, 0.0, a.x, a.y, -a.x, 0.0); }

// Restores the symmetry that rounding destroys. Otherwise the antisymmetric part grows from row to
// row of an elimination.
mat3 symmetric(mat3 m) { return 0.5 * (m + transpose(m)); }

// The inverse of a symmetric positive definite matrix, by L D L^T. Pivots below rounding are raised
// to it.
mat3 inverseOfSymmetric(mat3 m) {
    float least = 1.0e-7 * (m[0][0] + m[1][1] + m[2][2]) + 1.0e-30;
    float d0 = max(m[0][0], least);
    float l1 = m[0][1] / d0;
    float l2 = m[0][2] / d0;
    float d1 = max(m[1][1] - l1 * m[0][1], least);
    float l21 = (m[1][2] - l2 * m[0][1]) / d1;
    float d2 = max(m[2][2] - l2 * m[0][2] - l21 * l21 * d1, least);

    // Rows of L^-1: (1, 0, 0), (-l1, 1, 0), (low, -l21, 1).
    float low = l1 * l21 - l2;
    vec3 d = 1.0 / vec3(d0, d1, d2);
    float xy = -l1 * d.y - low * l21 * d.z;
    float xz = low * d.z;
    float yz = -l21 * d.z;
    return mat3(
        d.x + l1 * l1 * d.y + low * low * d.z, xy, xz, xy, d.y + l21 * l21 * d.z, yz, xz, yz, d.z);
}

#endif
