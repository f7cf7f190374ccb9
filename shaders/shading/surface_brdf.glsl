// Reflection of meshes' surfaces: glTF 2.0, appendix B.
#ifndef HAIRBENCH_SURFACE_BRDF_GLSL
#define HAIRBENCH_SURFACE_BRDF_GLSL

#include "shading/polygon_irradiance.glsl"

// A surface with a linear colour.
struct Surface {
    vec3 base_color;
    float metallic;
    float roughness;  // the square root of alpha
};

const float kSurfacePi = 3.14159265358979;
// A smoother surface would show no reflection of a point light.
const float kSmoothest = 0.045;

const float kDielectric = 0.04;  // reflectance at normal incidence

// Reflectance at normal incidence; scattered() has the colour of the diffuse part.
vec3 reflectance(Surface surface) {
    return mix(vec3(kDielectric), surface.base_color, surface.metallic);
}

vec3 scattered(Surface surface) { return surface.base_color * (1.0 - surface.metallic); }

// G / (4 |N.L| |N.V|) is separable (Smith 1967). This is the factor for one of the two directions.
float smithVisibility(float cosine, float alpha_squared) {
    return 1.0 / (cosine + sqrt(alpha_squared + (1.0 - alpha_squared) * cosine * cosine));
}

// Schlick 1994: how far reflection has grown to that of grazing light.
float grazingPart(float v_dot_h) { return pow(1.0 - v_dot_h, 5.0); }

// The matt part of surfaceBrdf(). A dielectric scatters the light that it does not reflect.
vec3 mattPart(Surface surface, float grazing) {
    return (1.0 - kDielectric) * (1.0 - grazing) * scattered(surface) / kSurfacePi;
}

// The same, also for light that scatters to the point from elsewhere: the directions may be
// opposite.
vec3 mattBrdf(Surface surface, vec3 to_eye, vec3 to_light) {
    vec3 middle = to_eye + to_light;
    middle *= inversesqrt(max(dot(middle, middle), 1e-12));
    return mattPart(surface, grazingPart(clamp(dot(to_eye, middle), 0.0, 1.0)));
}

// f, 1/sr. All directions are unit vectors away from the surface. 0 for light from behind it.
vec3 surfaceBrdf(Surface surface, vec3 normal, vec3 to_eye, vec3 to_light) {
    float n_dot_l = dot(normal, to_light);
    if (n_dot_l <= 0.0) return vec3(0.0);
    vec3 middle = normalize(to_eye + to_light);
    float n_dot_h = clamp(dot(normal, middle), 0.0, 1.0);
    float v_dot_h = clamp(dot(to_eye, middle), 0.0, 1.0);
    float roughness = max(surface.roughness, kSmoothest);
    float alpha_squared = roughness * roughness * roughness * roughness;
    // Trowbridge and Reitz 1975, also called GGX.
    float spread = n_dot_h * n_dot_h * (alpha_squared - 1.0) + 1.0;
    float distribution = alpha_squared / (kSurfacePi * spread * spread);
    float visible = smithVisibility(n_dot_l, alpha_squared) *
                    smithVisibility(abs(dot(normal, to_eye)), alpha_squared);
    float grazing = grazingPart(v_dot_h);
    vec3 straight = reflectance(surface);
    vec3 fresnel = straight + (1.0 - straight) * grazing;
    return mattPart(surface, grazing) + fresnel * distribution * visible;
}

// The light that a surface sends to the eye from a rectangle of radiance 1.
struct RectangleReflection {
    vec3 diffuse;  // relative to the rectangle's irradiance
    vec3 glossy;
};

// The half vector of light from `from` and the eye, with its slope divided by alpha.
vec3 stretchedFacet(vec3 from, vec3 normal, vec3 to_eye, float alpha) {
    vec3 half_vector = to_eye + cornerDirection(from);
    float height = dot(normal, half_vector);
    return cornerDirection((half_vector - height * normal) / alpha + height * normal);
}

const float kSidePieces = 2.0;  // pieces per side of the polygon of half vectors

// The distribution of facets is a cosine, stretched by alpha along the surface (Heitz, Dupuy, Hill
// and Neubelt 2016, Real-time polygonal-light shading with linearly transformed cosines). The part
// of the facets that mirrors the rectangle to the eye is therefore an irradiance: that of the
// rectangle's half vectors under the stretched cosine. They form a polygon with curved sides, so
// the result is exact for a smooth surface. Fresnel reflectance and shadowing change slowly and are
// evaluated for the mean of these facets.
RectangleReflection rectangleBrdf(Surface surface, vec3 normal, vec3 to_eye, vec3 to_light,
                                  mat4x3 corners) {
    // A normal map may put the eye below the surface; it is then moved to just above the horizon.
    to_eye = normalize(to_eye + normal * max(1e-3 - dot(normal, to_eye), 0.0));
    float roughness = max(surface.roughness, kSmoothest);
    float alpha = roughness * roughness;
    ClippedPolygon before = clipToHorizon(corners, normal);
    vec3 seen = vec3(0.0);
    vec3 from = before.at[4];
    vec3 last = stretchedFacet(from, normal, to_eye, alpha);
    for (int i = 0; i < 5; ++i) {
        for (float k = 1.0; k <= kSidePieces; ++k) {
            vec3 at = mix(from, before.at[i], k / kSidePieces);
            vec3 next = stretchedFacet(at, normal, to_eye, alpha);
            seen += 0.5 * edgeAngle(last, next);
            last = next;
        }
        from = before.at[i];
    }
    float along = dot(seen, normal);
    vec3 straight = reflectance(surface);
    RectangleReflection result =
        RectangleReflection(mattBrdf(surface, to_eye, to_light), vec3(0.0));
    if (along <= 1e-9) return result;

    vec3 facet = normalize(alpha * (seen - along * normal) + along * normal);
    float v_dot_h = clamp(dot(to_eye, facet), 0.0, 1.0);
    float n_dot_l = max(dot(normal, 2.0 * v_dot_h * facet - to_eye), 1e-3);
    float visible = smithVisibility(n_dot_l, alpha * alpha) *
                    smithVisibility(abs(dot(normal, to_eye)), alpha * alpha);
    vec3 fresnel = straight + (1.0 - straight) * grazingPart(v_dot_h);
    // The integral of D cos(h) dh is along / pi, and dl = 4 (v.h) dh.
    result.glossy = fresnel * (along / kSurfacePi) * visible * 4.0 * v_dot_h * n_dot_l /
                    max(dot(normal, facet), 1e-3);
    return result;
}

#endif
