// The light that a point of a strand sends to the eye, by the model that is asked for.
#ifndef HAIRBENCH_STRAND_SHADING_GLSL
#define HAIRBENCH_STRAND_SHADING_GLSL

#include "common/across.glsl"
#include "common/picture.glsl"
#include "shading/dual_scattering.glsl"
#include "shading/environment.glsl"
#include "shading/fiber_bsdf.glsl"
#include "shading/kajiya_kay.glsl"
#include "shading/lights.glsl"
#include "shading/options.glsl"
#include "shading/phong.glsl"
#include "shading/shadows.glsl"
#include "strands/options.glsl"

// A point of a strand's quad.
struct StrandFragment {
    vec3 position;  // m
    vec3 tangent;  // unit length, towards the tip
    vec3 to_eye;  // unit length
    float across;  // -1 at one edge, 1 at the other
    float along;  // 0 at the root, 1 at the tip
    float width;  // m
};

// Unit vectors: x along the strand, y across it towards the eye, z across both. On a round fibre
// the quad's point has the normal sqrt(1 - across^2) y - across z.
mat3 fiberFrame(StrandFragment fragment) {
    vec3 side = unitSide(fragment.to_eye, fragment.tangent);
    return mat3(fragment.tangent, cross(fragment.tangent, side), -side);
}

// The normal turns with the place across the strand, as that of the half of a cylinder that faces
// the camera (the published program takes the side vector, the same for the whole width).
vec3 cylinderNormal(StrandFragment fragment) {
    vec3 side = unitSide(fragment.to_eye, fragment.tangent);
    vec3 facing = cross(fragment.tangent, side);
    float x = clamp(fragment.across, -1.0, 1.0);
    return x * side + sqrt(1.0 - x * x) * facing;
}

Receiver receiverOf(StrandFragment fragment, vec3 passed) {
    return Receiver(fragment.position, vec3(0.0), fragment.tangent, fragment.width, passed);
}

float visiblePart(PictureParameters picture, uint light, StrandFragment fragment) {
    if (kMeshShadows == 0u && kHairShadows == kHairShadowsNone) return 1.0;
    vec3 passed = passedOpaque(picture);
    return visibility(lightPath(picture, light, receiverOf(fragment, passed)));
}

// A model's two terms of one light, without color.
struct Reflected {
    float diffuse;
    float specular;
};

Reflected reflectedLight(PictureParameters picture, StrandFragment fragment, vec3 normal,
                         LightSample light) {
    float exponent = widenedExponent(light, picture.exponent);
    Reflected reflected;
    if (kModel == kModelKajiyaKay) {
        KajiyaKayLight model =
            kajiyaKay(fragment.tangent, light.to_light, fragment.to_eye, exponent);
        // The lobe of Kajiya and Kay has a width along the strand only.
        reflected = Reflected(model.diffuse, model.specular);
        if (hasSpheres()) reflected.specular *= sqrt(exponent / picture.exponent);
    } else {
        PhongLight model = phong(normal, light.to_light, fragment.to_eye, exponent);
        reflected = Reflected(mattResponse(light, normal), model.specular);
        if (hasSpheres()) reflected.specular *= exponent / picture.exponent;
    }
    return reflected;
}

// Working colours of the models phong and kajiya_kay.
vec3 shadeOpaque(PictureParameters picture, StrandFragment fragment, vec3 hair_color) {
    vec3 normal = cylinderNormal(fragment);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), fragment.position);
        Reflected reflected = reflectedLight(picture, fragment, normal, light);
        float visible = visiblePart(picture, i, fragment);
        float ambient = kEnvironment != kEnvironmentNone ? 0.0 : picture.ambient;
        vec3 body = hair_color * (ambient + picture.diffuse * (visible * reflected.diffuse));
        sum += (body + picture.specular * (visible * reflected.specular)) * light.color;
    }
    return sum;
}

// A light's disc makes lobes wider: along the fibre, and round it by the logistic distribution's
// variance, which is (pi s)^2 / 3.
HairOptics widened(HairOptics optics, LightSample light) {
    if (!hasSpheres()) return optics;
    float variance = lightVariance(light);
    float inverse = optics.inverse_azimuthal_scale;
    optics.variances += variance;
    optics.inverse_azimuthal_scale = inverse * inversesqrt(1.0 + 0.303963551 * variance *
                                                                     inverse * inverse);
    return optics;
}

// Working colours of the models marschner and dual_scattering. A light's irradiance is pi times its
// color.
vec3 shadeFiber(PictureParameters picture, StrandFragment fragment) {
    HairOptics optics = HairOpticsReference(picture.optics).optics;
    mat3 frame = fiberFrame(fragment);
    vec3 to_eye = fragment.to_eye * frame;
    float h = clamp(fragment.across, -1.0, 1.0);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), fragment.position);
        HairOptics seen = widened(optics, light);
        vec3 to_light = light.to_light * frame;
        vec3 passed = vec3(0.0);
        if (kModel == kModelDualScattering) passed = passedForward(seen, to_light);
        LightPath path = lightPath(picture, i, receiverOf(fragment, passed));
        vec3 scattered;
        if (kModel == kModelMarschner) {
            // What has met a strand is lost.
            scattered =
                fiberScattering(seen, fiberView(seen, to_eye, h), to_light) * path.direct;
        } else {
            scattered = dualScattering(seen, to_eye, to_light, h, path);
        }
        sum += 3.14159265 * path.meshes * scattered * light.color;
    }
    return sum;
}

// The point in working colours. `hair_color` is the picture's, or with a texture's factor and a
// strand's own.
vec3 shadeStrand(PictureParameters picture, StrandFragment fragment, vec3 hair_color) {
    vec3 sum;
    if (kModel == kModelPhong || kModel == kModelKajiyaKay) {
        sum = shadeOpaque(picture, fragment, hair_color);
    } else {
        sum = shadeFiber(picture, fragment);
        if (kStrandTexture != 0u || kOwnColors != 0u)
            sum *= hair_color / max(picture.hair_color, vec3(1e-4));
    }
    if (kEnvironment == kEnvironmentHarmonics)
        sum += picture.ambient * hair_color * environmentLight(picture, cylinderNormal(fragment));
    return sum;
}

#endif
