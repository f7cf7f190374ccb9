// The lights of a picture.
#ifndef HAIRBENCH_LIGHTS_GLSL
#define HAIRBENCH_LIGHTS_GLSL

#include "common/picture.glsl"
#include "shading/options.glsl"
#include "shading/polygon_irradiance.glsl"

layout(buffer_reference, scalar) readonly buffer Lights { Light lights[]; };

// A light as a point sees it.
struct LightSample {
    vec3 to_light;  // unit length
    vec3 color;  // light that a white matt surface facing it shows: irradiance / pi
    float angular_radius;  // rad; 0 for points; for rectangles, the radius of the disc with equal
                           // variance
    // Rectangles only:
    mat4x3 corners;  // from the point, m
    float facing;  // irradiance of a surface that faces the light, for radiance 1; 0 for other
                   // lights
};

bool hasSpheres() { return (kLightKinds & kSomeSpheres) != 0u; }
bool hasRectangles() { return (kLightKinds & kSomeRectangles) != 0u; }
bool isRectangle(LightSample light) { return hasRectangles() && light.facing > 0.0; }

const float kLightInversePi = 0.318309886;
const float kNearestLight = 1e-3;  // m: a point light is not stronger than at this distance

// A rectangle shines to one side, with uniform radiance.
void sampleRectangle(inout LightSample result, Light light, vec3 offset) {
    if (dot(offset, light.to_light) <= 0.0) {
        result.color = vec3(0.0);
        return;
    }
    result.corners = mat4x3(offset - light.half_width - light.half_height,
                            offset + light.half_width - light.half_height,
                            offset + light.half_width + light.half_height,
                            offset - light.half_width + light.half_height);
    vec3 irradiance = vectorIrradiance(wholeRectangle(result.corners));
    result.facing = max(length(irradiance), 1e-18);
    result.to_light = irradiance / result.facing;
    if (light.reference_distance > 0.0) result.color *= kLightInversePi * result.facing;
    // The variances of its directions along both sides add up.
    float squared = dot(offset, offset);
    vec3 sides = cross(offset, light.half_width);
    vec3 heights = cross(offset, light.half_height);
    float variances = (dot(sides, sides) + dot(heights, heights)) / (3.0 * squared * squared);
    result.angular_radius = sqrt(2.0 * variances);
}

// Outside a sphere of uniform radiance, the irradiance of a surface that faces it is exactly pi L
// (r / d)^2. It falls off like that of a point. Inside, the sphere is all around.
LightSample lightAt(Light light, vec3 position) {
    // The 1e-18 m give a direction even at the light's position. They change no other direction.
    vec3 offset = light.position - position + vec3(0.0, 1e-18, 0.0);
    LightSample result = LightSample(normalize(offset), light.color, 0.0, mat4x3(0.0), 0.0);
    if ((kLightKinds & kSomeDirectional) != 0u && light.type == kLightDirectional)
        result.to_light = light.to_light;
    if (hasRectangles() && light.type == kLightRectangle) {
        sampleRectangle(result, light, offset);
        return result;
    }
    if ((kLightKinds & kSomeAttenuate) != 0u && light.reference_distance > 0.0) {
        float nearest = max(length(offset), max(light.radius, kNearestLight));
        float ratio = light.reference_distance / nearest;
        result.color *= ratio * ratio;
    }
    if (hasSpheres() && light.type == kLightSphere)
        result.angular_radius = asin(min(light.radius / max(length(offset), 1e-18), 1.0));
    if (hasSpheres() && light.type == kLightDirectional) result.angular_radius = light.radius;
    return result;
}

// Losses and scattering of light on its way to a point.
struct LightPath {
    float meshes;  // part that meshes let through, 0 to 1
    float strands;  // mean number of strands on the path
    float direct;  // part that meets no strand
    vec3 scattered;  // part that reaches the point through one or more strands
    float scatter_count;  // mean number of strands that the scattered light passes; at least 1
    vec3 ended;  // part that the strands behind the point would let through, there and back
    vec3 returned;  // part of `ended` that meshes behind the strands send back
    // Ratio of light that turns back in hair to light that comes straight in.
    float multiple_scattering;
};

const LightPath kFreePath =
    LightPath(1.0, 0.0, 1.0, vec3(0.0), 1.0, vec3(0.0), vec3(0.0), 1.0);

// For light that meets strands independently, the number of strands has a Poisson distribution.
// `transmittance` is the part that each strand lets through. exp(-n) meets none;
// exp(-n (1 - transmittance)) - exp(-n) arrives through some.
LightPath poissonPath(LightPath path, float strands, vec3 transmittance) {
    path.strands = strands;
    path.direct = exp(-strands);
    path.scattered = max(exp(-strands * (1.0 - transmittance)) - path.direct, 0.0);
    float through = strands * dot(transmittance, vec3(1.0 / 3.0));
    path.scatter_count = through > 1e-3 ? through / (1.0 - exp(-through)) : 1.0;
    return path;
}

Light pictureLight(PictureParameters picture, uint index) {
    return Lights(picture.lights).lights[index];
}

// Ratio of a surface's irradiance to that of a surface that faces the light. It is the cosine,
// except where the horizon cuts the light: there a parabola joins it smoothly. The parabola is off
// by up to 4 % of the sine of the light's angular radius (Snyder 1996, Area light sources for
// real-time graphics, has the exact ratio). Rectangles are exact.
float mattResponse(LightSample light, vec3 normal) {
    float cosine = dot(normal, light.to_light);
    if (isRectangle(light)) {
        if (isAboveHorizon(light.corners, normal)) return max(cosine, 0.0);
        vec3 irradiance = vectorIrradiance(clipToHorizon(light.corners, normal));
        return max(dot(irradiance, normal), 0.0) / light.facing;
    }
    if (!hasSpheres()) return max(cosine, 0.0);
    float size = sin(light.angular_radius);
    if (abs(cosine) >= size) return max(cosine, 0.0);
    float over = cosine + size;
    return over * over / (4.0 * size);
}

// Mean squared deviation of a light's directions from its centre along each of two axes, rad^2, as
// for a uniform disc. The light's size increases the variance of a lobe by this much.
float lightVariance(LightSample light) {
    return 0.25 * light.angular_radius * light.angular_radius;
}

// cos^n has the variance 1 / n.
float widenedExponent(LightSample light, float exponent) {
    if (!hasSpheres()) return exponent;
    return 1.0 / (1.0 / exponent + lightVariance(light));
}

#endif
