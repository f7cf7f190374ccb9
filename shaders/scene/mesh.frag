#version 460
// Shades a surface under the picture's lights. It is matt, with the same ambient part as the hair.
// If light is linear, its glTF material is used.
#extension GL_GOOGLE_include_directive : require
#define HAIRBENCH_SHADOW_BINDING 3
#include "common/picture.glsl"
#include "scene/options.glsl"
#include "shading/environment.glsl"
#include "shading/lights.glsl"
#include "shading/options.glsl"
#include "shading/shadows.glsl"
#include "shading/surface_brdf.glsl"
#include "shared/mesh_structs.h"

layout(push_constant, scalar) uniform Push { MeshPush push; };
layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D metallic_roughness_texture;
layout(binding = 2) uniform sampler2D normal_texture;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec2 coordinates;
#ifdef HAIRBENCH_INDIRECT
layout(location = 3) in vec3 indirect;
#endif
#ifdef HAIRBENCH_SCATTERING
layout(location = 4) in float curvature;  // 1/m
layout(buffer_reference, scalar) readonly buffer Responses { vec3 values[]; };
#endif
layout(location = 0) out vec4 color;

// `texel` is a normal with x towards growing u, y towards falling v and z outwards (glTF 2.0,
// section 3.9.3). The tangent is the triangle's, from screen-space derivatives. Vertex tangents
// (MikkTSpace) would be smoother.
vec3 mappedNormal(vec3 normal, vec3 position, vec2 coordinates, vec3 texel) {
    vec3 position_x = dFdx(position);
    vec3 position_y = dFdy(position);
    vec2 coordinates_x = dFdx(coordinates);
    vec2 coordinates_y = dFdy(coordinates);
    float turn = coordinates_x.x * coordinates_y.y - coordinates_y.x * coordinates_x.y;
    vec3 along_u = (position_x * coordinates_y.y - position_y * coordinates_x.y) * sign(turn);
    vec3 along_v = (position_y * coordinates_x.x - position_x * coordinates_y.x) * sign(turn);
    vec3 tangent = along_u - normal * dot(normal, along_u);
    if (dot(tangent, tangent) == 0.0) return normal;
    tangent = normalize(tangent);
    vec3 bitangent = cross(normal, tangent);
    if (dot(bitangent, along_v) > 0.0) bitangent = -bitangent;  // the texture is mirrored
    return normalize(texel.x * tangent + texel.y * bitangent + texel.z * normal);
}

vec3 surfaceNormal() {
    vec3 normal = normalize(vertex_normal);
    if (kDoubleSided == 1u && !gl_FrontFacing) normal = -normal;
    if (kNormalTexture == 0u) return normal;
    vec3 texel = 2.0 * texture(normal_texture, coordinates).rgb - 1.0;
    texel.xy *= push.normal_scale;
    return mappedNormal(normal, position, coordinates, texel);
}

// The part of a light that reaches a point `outward` of this one. Shadow lookups use the triangle's
// own normal, because the shadow map holds the depths of the flat triangle.
vec3 visiblePart(PictureParameters picture, uint light, vec3 outward) {
    if (kMeshShadows == 0u && kHairShadows == kHairShadowsNone) return vec3(1.0);
    vec3 flat_normal = cross(dFdx(position), dFdy(position));
    flat_normal /= max(length(flat_normal), 1e-30);
    Receiver receiver =
        Receiver(position + outward, flat_normal, vec3(0.0), 0.0, surfaceTransmittance(picture));
    return visibility(lightPath(picture, light, receiver));
}

// A matt surface in working colours, like the head of the thesis.
vec3 shadeMatt(PictureParameters picture, vec3 base_color, vec3 normal) {
    vec3 sum = vec3(0.0);
    float ambient = kEnvironment != 0u ? 0.0 : picture.ambient;
    for (uint i = 0u; i < kLightCount; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), position);
        vec3 lit = visiblePart(picture, i, vec3(0.0)) * mattResponse(light, normal);
        sum += base_color * (ambient + picture.diffuse * lit) * light.color;
    }
    if (kEnvironment != 0u)
        sum += picture.ambient * base_color * environmentLight(picture, normal);
    return sum;
}

// A light's disc widens the highlight. The half vector turns by half as much as the light, and the
// variance of a slope along each axis is alpha^2 / 2.
Surface widened(Surface surface, LightSample light) {
    if (hasSpheres())
        surface.roughness = sqrt(sqrt(pow(surface.roughness, 4.0) + 0.5 * lightVariance(light)));
    return surface;
}

#ifdef HAIRBENCH_SCATTERING
// Light leaves a matt sphere where it did not enter (Penner 2011, Pre-Integrated Skin Shading). The
// table holds what the sphere that has the surface's curvature shows, as a ratio to its irradiance
// where it faces the light.
vec3 sphereResponse(float cosine) {
    float column = clamp(0.5 * cosine + 0.5, 0.0, 1.0) * float(kScatteringCosines - 1u);
    float row = clamp(curvature * push.scattering / kScatteringStep, 0.0,
                      float(kScatteringCurvatures - 1u));
    uint left = min(uint(column), kScatteringCosines - 2u);
    uint low = min(uint(row), kScatteringCurvatures - 2u);
    uint first = low * kScatteringCosines + left;
    uint second = first + kScatteringCosines;
    Responses table = Responses(push.responses);
    float along = column - float(left);
    return mix(mix(table.values[first], table.values[first + 1u], along),
               mix(table.values[second], table.values[second + 1u], along), row - float(low));
}

// As mattResponse(), with light that scatters. Both the light's disc and scattering blur the
// horizon, and their variances add up.
vec3 scatteredResponse(LightSample light, vec3 normal, float matt) {
    float cosine = dot(normal, light.to_light);
    float sharp = max(cosine, 0.0);
    vec3 by_scattering = sphereResponse(cosine) - sharp;
    float by_disc = matt - sharp;
    vec3 both = sqrt(by_scattering * by_scattering + by_disc * by_disc);
    return max(sharp + mix(by_scattering + by_disc, both, greaterThan(by_scattering, vec3(0.0))),
               vec3(0.0));
}

// m: the size of texels of maps, and the greatest distance.
const float kClear = 0.001;
const float kMostAbove = 0.006;

// The sphere whose response the table has does not throw its shadow on itself. A point near or
// beyond its horizon is therefore moved outward to where it sees the light, kClear beside the sphere.
vec3 aboveOwnShadow(LightSample light, vec3 normal) {
    float cosine = dot(normal, light.to_light);
    float clear = kClear * clamp(1.0 - 5.0 * cosine, 0.0, 1.0);
    if (clear <= 0.0 || curvature <= 0.0) return vec3(0.0);
    float behind = min(cosine, 0.0);
    float stretch = inversesqrt(max(1.0 - behind * behind, 1e-6));
    float above = (stretch - 1.0) / curvature + stretch * clear;
    return min(above, kMostAbove) * normal;
}
#endif

// The surface in linear light. Ambient light is reflected as if it were equally blurred by a matt
// surface.
vec3 shadeSurface(PictureParameters picture, Surface surface, vec3 normal, vec3 to_eye) {
    vec3 sum = vec3(0.0);
    vec3 around = vec3(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), position);
        around += light.color;
        float matt = mattResponse(light, normal);
#ifdef HAIRBENCH_SCATTERING
        vec3 visible = visiblePart(picture, i, aboveOwnShadow(light, normal));
        vec3 elsewhere = scatteredResponse(light, normal, matt) - matt;
#else
        vec3 visible = visiblePart(picture, i, vec3(0.0));
#endif
        if (isRectangle(light)) {
            RectangleReflection of =
                rectangleBrdf(surface, normal, to_eye, light.to_light, light.corners);
            vec3 reflected = matt * of.diffuse + of.glossy / light.facing;
#ifdef HAIRBENCH_SCATTERING
            sum += kSurfacePi * visible * elsewhere * of.diffuse * light.color;
#endif
            sum += kSurfacePi * visible * reflected * light.color;
            continue;
        }
        vec3 f = surfaceBrdf(widened(surface, light), normal, to_eye, light.to_light);
        vec3 lit = visible * matt;
        sum += kSurfacePi * f * lit * light.color;
#ifdef HAIRBENCH_SCATTERING
        // surfaceBrdf() has no light from behind the surface, also where a disc is partly above.
        if (dot(normal, light.to_light) <= 0.0) elsewhere += matt;
        sum += kSurfacePi * visible * elsewhere * mattBrdf(surface, to_eye, light.to_light) *
               light.color;
#endif
    }
    vec3 straight = reflectance(surface);
    vec3 diffuse = (1.0 - straight) * scattered(surface);
    if (kEnvironment != 0u) {
        vec3 mirrored = environmentLight(picture, reflect(-to_eye, normal));
        sum += picture.ambient *
               (diffuse * environmentLight(picture, normal) + straight * mirrored);
    } else if (kModel != kModelMarschner && kModel != kModelDualScattering) {
        sum += picture.ambient * (diffuse + straight) * around;
    }
#ifdef HAIRBENCH_INDIRECT
    sum += diffuse * indirect;
#endif
    return sum;
}

void main() {
    PictureParameters picture = PictureReference(push.picture).parameters;
    vec4 base_color = vec4(push.base_color, push.opacity);
    Surface surface = Surface(vec3(0.0), push.metallic, push.roughness);
    if (kBaseColorTexture == 1u) base_color *= texture(base_color_texture, coordinates);
    if (kMetallicRoughnessTexture == 1u) {
        vec4 texel = texture(metallic_roughness_texture, coordinates);
        surface.metallic *= texel.b;
        surface.roughness *= texel.g;
    }
    surface.base_color = base_color.rgb;
    vec3 normal = surfaceNormal();
    vec3 to_eye = normalize(picture.eye - position);
    vec3 light = kLinearLight == 1u ? shadeSurface(picture, surface, normal, to_eye)
                                    : shadeMatt(picture, base_color.rgb, normal);
    if (kMask == 1u && base_color.a < push.cutoff) discard;  // after the last derivative
    color = vec4(light, 1.0);
}
