// Irradiance by polygons of uniform radiance: Lambert 1760, Photometria; Baum, Rushmeier and Winget
// 1989, Improving radiosity solutions through the use of analytically determined form-factors.
#ifndef HAIRBENCH_POLYGON_IRRADIANCE_GLSL
#define HAIRBENCH_POLYGON_IRRADIANCE_GLSL

// The corners of a rectangle in order, after a plane through the point may have cut it. If there
// are fewer than five, the last one is repeated. Lengths don't matter.
struct ClippedPolygon {
    vec3 at[5];
};

// The angle between two directions, along the axis that turns one into the other. For small angles,
// angle over sine is the arcsine series, so that differences between edges keep their digits.
vec3 edgeAngle(vec3 a, vec3 b) {
    vec3 across = cross(a, b);
    float squared = dot(across, across);
    float cosine = dot(a, b);
    if (cosine > 0.95) {
        return across * (1.0 + squared * (1.0 / 6.0 + squared * (3.0 / 40.0 + squared *
                                         (15.0 / 336.0 + squared * (105.0 / 3456.0)))));
    }
    float sine = sqrt(max(squared, 1e-20));
    return across * (atan(sine, cosine) / sine);
}

vec3 cornerDirection(vec3 corner) {
    return corner * inversesqrt(max(dot(corner, corner), 1e-30));
}

// The vector irradiance of a polygon of radiance 1. Its dot product with n is the irradiance of a
// surface with normal n, provided that the whole polygon is in front of the surface. It points to
// the polygon if the corners run clockwise as seen from the point.
vec3 vectorIrradiance(ClippedPolygon polygon) {
    vec3 sum = vec3(0.0);
    vec3 last = cornerDirection(polygon.at[4]);
    for (int i = 0; i < 5; ++i) {
        vec3 next = cornerDirection(polygon.at[i]);
        sum += edgeAngle(last, next);
        last = next;
    }
    return 0.5 * sum;
}

ClippedPolygon wholeRectangle(mat4x3 corners) {
    return ClippedPolygon(vec3[5](corners[0], corners[1], corners[2], corners[3], corners[3]));
}

bool isAboveHorizon(mat4x3 corners, vec3 normal) {
    return all(greaterThanEqual(normal * corners, vec4(0.0)));
}

// Returns the part of a rectangle in front of the surface. If there is none, all corners are 0.
ClippedPolygon clipToHorizon(mat4x3 corners, vec3 normal) {
    const vec3 none = vec3(0.0);
    ClippedPolygon result = ClippedPolygon(vec3[5](none, none, none, none, none));
    vec4 heights = normal * corners;
    int count = 0;
    vec3 last = none;
    for (int i = 0; i < 4; ++i) {
        int next = (i + 1) & 3;
        if (heights[i] >= 0.0) {
            last = corners[i];
            result.at[count++] = last;
        }
        if ((heights[i] >= 0.0) != (heights[next] >= 0.0)) {
            last = mix(corners[i], corners[next], heights[i] / (heights[i] - heights[next]));
            result.at[count++] = last;
        }
    }
    for (int i = count; i < 5; ++i) result.at[i] = last;
    return result;
}

#endif
