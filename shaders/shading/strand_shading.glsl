// The light that a point of a strand sends to the eye, by the chosen model.
#ifndef HAIRBENCH_STRAND_SHADING_GLSL
#define HAIRBENCH_STRAND_SHADING_GLSL

#include "common/across.glsl"
#include "common/picture.glsl"
#include "extension/shading.glsl"
#include "extension/turns.glsl"
#include "shading/dual_scattering.glsl"
#include "shading/environment.glsl"
#include "shading/fiber_bsdf.glsl"
#include "shading/kajiya_kay.glsl"
#include "shading/lights.glsl"
#include "shading/options.glsl"
#include "shading/phong.glsl"
#include "shading/shadows.glsl"
#include "strands/options.glsl"
#include "strands/own_color.glsl"

// A point of a strand's quad.
struct StrandFragment {
    vec3 position;  // m
    vec3 tangent;  // unit length, towards the tip
    vec3 to_eye;  // unit length
    float across;  // -1 at one edge, 1 at the other
    float along;  // 0 at the root, 1 at the tip
    float width;  // m
    float fiber_width;  // m: width of one of the hairs that a merged strand stands for; otherwise
                        // `width`
    float power;  // the strand's colour is the hair's to this power: strands/own_color.glsl
};

// Unit vectors: x along the strand, y across it towards the eye, z perpendicular to both. On a
// round fibre the normal at the quad's point is sqrt(1 - across^2) y - across z.
mat3 fiberFrame(StrandFragment fragment) {
    vec3 side = unitSide(fragment.to_eye, fragment.tangent);
    return mat3(fragment.tangent, cross(fragment.tangent, side), -side);
}

// The normal varies across the strand like that of the half cylinder that faces the camera. The
// published program uses the side vector over the whole width.
vec3 cylinderNormal(StrandFragment fragment) {
    vec3 side = unitSide(fragment.to_eye, fragment.tangent);
    vec3 facing = cross(fragment.tangent, side);
    float x = clamp(fragment.across, -1.0, 1.0);
    return x * side + sqrt(1.0 - x * x) * facing;
}

Receiver receiverOf(StrandFragment fragment, vec3 transmittance) {
    return Receiver(fragment.position, vec3(0.0), fragment.tangent, fragment.width, transmittance);
}

float visiblePart(PictureParameters picture, uint light, StrandFragment fragment) {
    if (kMeshShadows == 0u && kHairShadows == kHairShadowsNone) return 1.0;
    vec3 transmittance = surfaceTransmittance(picture);
    return visibility(lightPath(picture, light, receiverOf(fragment, transmittance))).g;
}

// A model's two terms for one light, without colour.
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
        // The lobe of Kajiya and Kay has a width only along the strand.
        reflected = Reflected(model.diffuse, model.specular);
        if (hasSpheres()) reflected.specular *= sqrt(exponent / picture.exponent);
    } else {
        PhongLight model = phong(normal, light.to_light, fragment.to_eye, exponent);
        reflected = Reflected(mattResponse(light, normal), model.specular);
        if (hasSpheres()) reflected.specular *= exponent / picture.exponent;
    }
    return reflected;
}

// Shades with the models phong and kajiya_kay, in working colours.
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

// Widens lobes by the variances of a light's directions along the fibre and round it, rad^2. The
// variance of the logistic distribution is (pi s)^2 / 3.
HairOptics widenedBy(HairOptics optics, vec2 variances) {
    float inverse = optics.inverse_azimuthal_scale;
    optics.variances += variances.x;
    optics.inverse_azimuthal_scale = inverse * inversesqrt(1.0 + 0.303963551 * variances.y *
                                                                     inverse * inverse);
    return optics;
}

HairOptics widened(HairOptics optics, LightSample light) {
    return hasSpheres() ? widenedBy(optics, vec2(lightVariance(light))) : optics;
}

// The scattering towards the eye of light that comes along `path`, without the losses by meshes.
vec3 scatteringToEye(HairOptics optics, FiberView view, vec3 to_eye, vec3 to_light,
                    LightPath path) {
    // marschner loses all light that has met a strand.
    if (kModel == kModelMarschner) return fiberScattering(optics, view, to_light) * path.direct;
    return dualScattering(optics, view, to_eye, to_light, path);
}

// The part of a fibre's width that a pixel sees, as h.
struct Footprint {
    float h;  // at the pixel's centre
    float from;
    float to;
};

Footprint footprintOf(PictureParameters picture, StrandFragment fragment) {
    float h = clamp(fragment.across, -1.0, 1.0);
    if (kFarField == 0u) return Footprint(h, h, h);
    float depth = max((picture.view_projection * vec4(fragment.position, 1.0)).w, 0.0);
    float pixel = picture.pixel_near + picture.pixel_slope * depth;
    float reach = pixel / max(fragment.fiber_width, 1e-9);
    return Footprint(h, max(h - reach, -1.0), min(h + reach, 1.0));
}

// Footprints narrower than this, in h, take the light of their middle.
const float kNearField = 0.2;
const int kFootprintParts = 8;

// The mean over the footprint, in parts of equal angle gamma with h = sin(gamma). The azimuths of R
// then have equal steps.
vec3 footprintScattering(HairOptics optics, Footprint footprint, vec3 to_eye, vec3 to_light,
                         LightPath path) {
    if (kFarField == 0u || footprint.to - footprint.from < kNearField) {
        FiberView view = fiberView(optics, to_eye, footprint.h);
        return scatteringToEye(optics, view, to_eye, to_light, path);
    }
    float from = asin(footprint.from);
    float turn = (asin(footprint.to) - from) / float(kFootprintParts);
    float part = 2.0 * sin(0.5 * turn) / (footprint.to - footprint.from);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kFootprintParts; ++i) {
        float gamma = from + (float(i) + 0.5) * turn;
        FiberView view = fiberViewRound(optics, to_eye, gamma, turn);
        sum += part * cos(gamma) * scatteringToEye(optics, view, to_eye, to_light, path);
    }
    return sum;
}

// ---- Rectangular lights ----

// A rectangle is split until a part extends at most this many standard deviations of the fibre's
// narrowest lobe to each side. kMostParts limits the parts along each side.
const float kPartReach = 1.5;
const float kMostParts = 4.0;

// The variances of the directions of a part with these sides, m, along the fibre and round it.
// Angles round it are wider by 1 / cos(theta).
vec2 partVariances(vec3 to_part, vec3 half_width, vec3 half_height, vec3 tangent) {
    float inverse = inversesqrt(max(dot(to_part, to_part), 1e-18));
    vec3 direction = inverse * to_part;
    vec3 round = cross(tangent, direction);  // as long as the cosine
    float cos_squared = max(dot(round, round), 1e-4);
    vec3 up = tangent - dot(tangent, direction) * direction;
    vec2 along = vec2(dot(up, half_width), dot(up, half_height));
    vec2 azimuth = vec2(dot(round, half_width), dot(round, half_height)) * inversesqrt(cos_squared);
    vec2 variances = vec2(dot(along, along), dot(azimuth, azimuth)) *
                     (inverse * inverse / (3.0 * cos_squared));
    return min(variances, vec2(3.28986813));  // variance of a full turn
}

// A fibre's scattering of a rectangle's light, relative to the irradiance of a surface that faces
// it. It is the sum over parts, each weighted by its solid angle.
vec3 rectangleScattering(HairOptics optics, mat3 frame, Footprint footprint, vec3 to_eye,
                         LightSample light, LightPath path) {
    vec3 middle = 0.25 * (light.corners[0] + light.corners[1] + light.corners[2] +
                          light.corners[3]);
    vec3 half_width = 0.5 * (light.corners[1] - light.corners[0]);
    vec3 half_height = 0.5 * (light.corners[3] - light.corners[0]);
    vec3 normal = normalize(cross(half_width, half_height));
    // The lobes are those of TT and of the azimuths, where the deviation is (pi s) / sqrt(3).
    float narrowest = min(sqrt(optics.variances.y), 1.81379936 / optics.inverse_azimuthal_scale);
    float reach = kPartReach * narrowest * length(middle);
    vec2 parts = clamp(ceil(vec2(length(half_width), length(half_height)) / reach), vec2(1.0),
                       vec2(kMostParts));
    vec3 sum = vec3(0.0);
    float facing = 0.0;
    for (float y = 0.5; y < parts.y; ++y) {
        for (float x = 0.5; x < parts.x; ++x) {
            vec2 place = 2.0 * vec2(x, y) / parts - 1.0;
            vec3 to_part = middle + place.x * half_width + place.y * half_height;
            float inverse = inversesqrt(max(dot(to_part, to_part), 1e-18));
            vec3 direction = inverse * to_part;
            float angle = max(dot(direction, normal), 0.0) * inverse * inverse;
            HairOptics seen = widenedBy(optics, partVariances(to_part, half_width / parts.x,
                                                              half_height / parts.y, frame[0]));
            sum += angle *
                   footprintScattering(seen, footprint, to_eye, direction * frame, path);
            facing += angle * dot(direction, light.to_light);
        }
    }
    return sum / max(facing, 1e-18);
}

// The optics of a strand with its own colour. `painted`: the texture's factor.
HairOptics ownOptics(PictureParameters picture, StrandFragment fragment, vec3 painted) {
    HairOptics optics = HairOpticsReference(picture.optics).optics;
    if (kStrandTexture != 0u) optics.body = painted;
    if (kOwnColors != 0u) {
        vec2 powers = vec2(meanPower(picture, fragment.along), fragment.power);
        vec2 rows = max((powers - optics.least_power) * optics.rows_per_power, 0.0);
        optics.mean_row = rows.x;
        optics.own_row = rows.y;
        optics.absorption *= fragment.power * fragment.power;
    }
    return optics;
}

// Shades with the models marschner and dual_scattering, in working colours. A light's irradiance is
// pi times its colour.
vec3 shadeFiber(PictureParameters picture, StrandFragment fragment, vec3 painted) {
    HairOptics optics = ownOptics(picture, fragment, painted);
    mat3 frame = fiberFrame(fragment);
    vec3 to_eye = fragment.to_eye * frame;
    Footprint footprint = footprintOf(picture, fragment);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kLightCount; ++i) {
        LightSample light = lightAt(pictureLight(picture, i), fragment.position);
        HairOptics seen = widened(optics, light);
        vec3 to_light = light.to_light * frame;
        vec3 transmittance = vec3(0.0);
        if (kModel == kModelDualScattering) transmittance = forwardScattering(seen, to_light);
        LightPath path = lightPath(picture, i, receiverOf(fragment, transmittance));
        vec3 scattered;
        if (isRectangle(light)) {
            scattered = rectangleScattering(optics, frame, footprint, to_eye, light, path);
        } else {
            scattered = footprintScattering(seen, footprint, to_eye, to_light, path);
        }
        sum += 3.14159265 * path.meshes * scattered * light.color;
    }
    return sum;
}

// ---- A shading model from the scene ----

#ifdef HAIRBENCH_EXTENDED_SHADING

// The picture for the functions below.
PictureParameters extended_picture;

uint lightCount() { return kLightCount; }

HairLight hairLight(HairPoint point, uint light) {
    if (light >= kLightCount) return HairLight(vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0);
    LightSample at = lightAt(pictureLight(extended_picture, light), point.position);
    float visible = 1.0;
    if (kMeshShadows != 0u || kHairShadows != kHairShadowsNone) {
        Receiver receiver = Receiver(point.position, vec3(0.0), point.tangent, point.width,
                                     surfaceTransmittance(extended_picture));
        visible = visibility(lightPath(extended_picture, light, receiver)).g;
    }
    return HairLight(at.to_light, at.color, visible);
}

HairShading hairShading() {
    float ambient = kEnvironment != kEnvironmentNone ? 0.0 : extended_picture.ambient;
    return HairShading(ambient, extended_picture.diffuse, extended_picture.specular,
                       extended_picture.exponent);
}

// The sRGB transfer function, IEC 61966-2-1:1999.
vec3 workingColor(vec3 display) {
    if (kLinearLight == 0u) return display;
    vec3 curved = pow((display + 0.055) / 1.055, vec3(2.4));
    return mix(curved, display / 12.92, lessThanEqual(display, vec3(0.04045)));
}

vec3 shadeExtended(PictureParameters picture, StrandFragment fragment, vec3 hair_color) {
    extended_picture = picture;
    beginTurns();
    return shadeHair(HairPoint(fragment.position, fragment.tangent, cylinderNormal(fragment),
                               fragment.to_eye, fragment.across, fragment.along, fragment.width,
                               hair_color));
}

#endif

// Shades the point in working colours. `painted` is the texture's factor on the hair's colour.
vec3 shadeStrand(PictureParameters picture, StrandFragment fragment, vec3 painted) {
    vec3 hair_color = picture.hair_color * painted * ownColor(picture, fragment.power);
    vec3 sum;
#ifdef HAIRBENCH_EXTENDED_SHADING
    if (kModel == kModelExtension) {
        sum = shadeExtended(picture, fragment, hair_color);
    } else
#endif
    if (kModel == kModelPhong || kModel == kModelKajiyaKay) {
        sum = shadeOpaque(picture, fragment, hair_color);
    } else {
        sum = shadeFiber(picture, fragment, painted);
    }
    if (kEnvironment == kEnvironmentHarmonics)
        sum += picture.ambient * hair_color * environmentLight(picture, cylinderNormal(fragment));
    return sum;
}

#endif
