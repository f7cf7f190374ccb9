// Occlusion between a light and a point: shadow maps of meshes; deep opacity maps and deep shadow
// maps of hair, or rays in its acceleration structure.
#ifndef HAIRBENCH_SHADOWS_GLSL
#define HAIRBENCH_SHADOWS_GLSL

#include "common/depth.glsl"
#include "common/picture.glsl"
#include "shading/lights.glsl"
#include "shading/options.glsl"
#include "shadows/layers.glsl"

// ShadowPass::images() use this binding and the next two.
#ifndef HAIRBENCH_SHADOW_BINDING
#define HAIRBENCH_SHADOW_BINDING 1
#endif

layout(buffer_reference, scalar) readonly buffer ShadowReference { ShadowParameters parameters; };
layout(binding = HAIRBENCH_SHADOW_BINDING) uniform sampler2D mesh_depths;
layout(binding = HAIRBENCH_SHADOW_BINDING + 1) uniform sampler2D hair_depths;
layout(binding = HAIRBENCH_SHADOW_BINDING + 2) uniform sampler2D hair_layers;

// The query: a point of a surface or of a strand.
struct Receiver {
    vec3 position;  // m
    vec3 normal;  // of a surface, with either sign; 0 for a strand
    vec3 tangent;  // of a strand, unit length
    float width;  // m, of a strand
    vec3 transmittance;  // part of the light that each strand in between lets through
};

// A point in a map. The depths of nearby texels are assumed to lie on a plane through it.
struct ShadowPoint {
    vec2 texel;  // within the light's part of the atlas
    float depth;
    vec2 slope;  // of depth, per texel
    float most_slope;  // limit for each component of `slope`
    float bias;  // in depth: whatever is in front of the point by less than this does not shade it
    vec3 log_transmittance;  // log of Receiver::transmittance
    vec3 log_round_trip;  // log of the part that a strand in between lets through there and back
    // Strands only:
    vec2 line;  // direction in the map, unit length
    vec2 line_slope;  // depth per texel along `line`
    float half_width;  // texels
    float own_depth;  // m: anything in front by less is the strand itself
};

// Steeper surfaces (tangent of the angle to the light) are treated as this steep: light that comes
// in at less than 6 degrees shows little.
const float kSteepest = 10.0;
// Bias for surfaces. kSurfaceBias is half a texel for rounding. kTurned allows for a neighbouring
// triangle that is turned by 5 degrees (in rad): within the filter it rises by (1 + tan^2) times
// the angle per texel.
const float kSurfaceBias = 0.5;
const float kTurned = 0.0873;
// Bias for strands. Strands lie on surfaces of unknown slope. A surface of 63 degrees may rise by
// this factor times the filter's half width plus half a texel.
const float kStrandBias = 2.0;
// A ray through a texel may meet the strand itself up to this many strand widths before the point.
const float kOwnDepth = 1.0;
// For multipleScattering(). The first strands of single texels scatter in depth by the thickness of
// a lock. The slope of their surface is therefore taken over kReach, m. Where the surface ends, it
// falls by kEdge times kReach.
const float kReach = 0.008;
const float kEdge = 3.0;
// Compared with Mitsuba over the light's cosine, paths among strands are about right at 0.8 without
// a correction.
const float kStraight = 0.8;
const float kEyeH = 2.4;  // 1 + 2 mu at mu = 0.7

vec2 planeSlope(ShadowMap map, vec3 clip, vec3 normal, float side) {
    vec3 a = abs(normal.x) > 0.5 ? vec3(-normal.y, normal.x, 0.0) : vec3(0.0, -normal.z, normal.y);
    vec3 b = cross(normal, a);
    vec4 along_a = map.view_projection * vec4(a, 0.0);
    vec4 along_b = map.view_projection * vec4(b, 0.0);
    vec3 d_a = along_a.xyz - clip * along_a.w;
    vec3 d_b = along_b.xyz - clip * along_b.w;
    float area = d_a.x * d_b.y - d_a.y * d_b.x;
    vec2 slope = vec2(d_a.z * d_b.y - d_a.y * d_b.z, d_a.x * d_b.z - d_a.z * d_b.x);
    return slope / (abs(area) < 1e-20 ? 1e-20 : area) * 2.0 / side;  // clip space is 2 wide
}

// The number of strands that a ray of light through a texel meets before it passes the point, and
// behind it. If the ray hits the strand itself, that strand is not counted.
struct RayStrands {
    float before;
    float behind;
};

// The ray meets its first strand `ahead` metres before the point.
RayStrands strandsAlongRay(vec4 layers, float ahead, ShadowMap map, ShadowPoint point,
                        bool hits_itself) {
    float before = 0.0;
    if (ahead > point.own_depth) {
        before = strandsBefore(layers, ahead, map.layer_depth);
        if (hits_itself) before -= layerPart(ahead, map.layer_depth);
        before = max(before, 1.0);  // the first strand on the ray
    }
    float all = layers.w - (hits_itself ? 1.0 : 0.0);
    return RayStrands(before, max(all - before, 0.0));
}

// Adds a texel of a deep shadow map to a path with this weight. `depth` is the depth of the point
// on the texel's plane; it is moved along the strand to where the strand passes the ray.
void addRay(inout LightPath path, ShadowMap map, ShadowPoint point, ivec2 at, vec2 offset,
            float depth, float weight) {
    float along = dot(offset, point.line);
    float most = point.most_slope * (abs(offset.x) + abs(offset.y));
    float beside = notBeyondFar(depth + clamp(dot(point.line_slope, offset), -most, most));
    bool hits_itself = length(offset - along * point.line) < point.half_width;
    float nearest = texelFetch(hair_depths, at, 0).r;
    float ahead = viewDepth(map.depth_terms, beside) - viewDepth(map.depth_terms, nearest);
    RayStrands met =
        strandsAlongRay(texelFetch(hair_layers, at, 0), ahead, map, point, hits_itself);
    path.strands += weight * met.before;
    if (met.before == 0.0) {
        path.direct += weight;
    } else {
        vec3 through = weight * exp(met.before * point.log_transmittance);
        path.scattered += through;
        path.scatter_count += met.before * dot(through, vec3(1.0));
    }
    vec3 ended = weight * exp(met.behind * point.log_round_trip);
    path.ended += ended;
    if (kMeshShadows != 0 && (map.casters & kMeshesCast) != 0u) {
        float surface = texelFetch(mesh_depths, at, 0).r;
        if (isNearer(surface, float(kFarDepth)) && isNearer(depth, surface))
            path.returned += ended;
    }
}

// The mean over a square of `half_width` texels to each side. Texels partly inside count in
// proportion to their area. At 0.5 this is bilinear interpolation of the texels' results.
LightPath filteredPath(ShadowMap map, ShadowPoint point, float half_width) {
    vec2 whole = floor(point.texel);
    vec2 centre = point.texel - whole;  // small, so that the weights are not rounded
    ivec2 first = ivec2(floor(centre - half_width));
    ivec2 last = ivec2(ceil(centre + half_width)) - 1;
    bool meshes_cast = kMeshShadows != 0 && (map.casters & kMeshesCast) != 0u;
    bool hair_casts = kHairShadows != kHairShadowsNone && kHairShadows != kHairShadowsRays &&
                      (map.casters & kHairCasts) != 0u;
    LightPath path = LightPath(0.0, 0.0, 0.0, vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 1.0);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            vec2 low = vec2(x, y);
            vec2 inside = min(low + 1.0, centre + half_width) - max(low, centre - half_width);
            float weight = inside.x * inside.y / (4.0 * half_width * half_width);
            vec2 offset = low + 0.5 - centre;
            vec2 rise = point.slope * offset;
            vec2 most = point.most_slope * abs(offset);
            vec2 limited = clamp(rise, -most, most);
            float depth = notBeyondFar(point.depth + limited.x + limited.y);
            ivec2 at = ivec2(map.corner) + ivec2(whole) + ivec2(x, y);
            if (meshes_cast) {
                float drawn = texelFetch(mesh_depths, at, 0).r;
                bool lit = isNearerOrEqual(nearer(depth, point.bias), drawn);
                path.meshes += lit ? weight : 0.0;
            }
            if (!hair_casts) continue;
            if (kHairShadows == kHairShadowsDeepShadow) {
                addRay(path, map, point, at, offset, depth, weight);
            } else {
                float nearest = texelFetch(hair_depths, at, 0).r;
                float behind =
                    viewDepth(map.depth_terms, depth) - viewDepth(map.depth_terms, nearest);
                vec4 layers = texelFetch(hair_layers, at, 0);
                path.strands += weight * strandsBefore(layers, behind, map.layer_depth);
            }
        }
    }
    if (!meshes_cast) path.meshes = 1.0;
    if (!hair_casts) {
        path.direct = 1.0;
        path.scatter_count = 1.0;
    } else if (kHairShadows == kHairShadowsDeepShadow) {
        float through = dot(path.scattered, vec3(1.0));
        path.scatter_count = through > 1e-6 ? max(path.scatter_count / through, 1.0) : 1.0;
    } else {
        path = poissonPath(path, path.strands, exp(point.log_transmittance));
    }
    return path;
}

// Distance in metres along the light's view to the first strand in a texel. If skin is in front of
// it, the hair ends on the skin, and its surface is assumed to continue at `here`. If there is
// neither, the surface falls steeply.
float firstStrand(ShadowMap map, vec2 texel, float side, float here) {
    ivec2 at = ivec2(map.corner) + ivec2(clamp(texel, vec2(0.0), vec2(side - 1.0)));
    float depth = texelFetch(hair_depths, at, 0).r;
    if (kMeshShadows != 0 && (map.casters & kMeshesCast) != 0u &&
        isNearer(texelFetch(mesh_depths, at, 0).r, depth))
        return here;
    return isNearer(depth, float(kFarDepth)) ? viewDepth(map.depth_terms, depth)
                                             : here + kEdge * kReach;
}

// Light that grazes hair leaves it sooner than light that comes straight in. A deep medium shows
// H(mu_0) H(mu) times the light of single scattering (Chandrasekhar 1960, Radiative Transfer; mu_0
// and mu: cosines of the light and the eye to its surface), so multiple scattering adds H(mu_0)
// H(mu) - 1 times as much. This function returns the ratio of that to its value at a cosine of
// kStraight. H(mu) is 1 + 2 mu, for no absorption (Hapke 1981, Bidirectional reflectance
// spectroscopy 1); the eye's is kEyeH. `slope` is the surface's to a plane across the light.
float gainOfSlope(vec2 slope) {
    float cosine = inversesqrt(1.0 + dot(slope, slope));
    return ((1.0 + 2.0 * cosine) * kEyeH - 1.0) / ((1.0 + 2.0 * kStraight) * kEyeH - 1.0);
}

// gainOfSlope() of the surface of the first strands, with its slope taken over kReach to both
// sides.
float multipleScattering(ShadowMap map, vec2 texel, float side, float texel_size) {
    float nearest = texelFetch(hair_depths, ivec2(map.corner) + ivec2(texel), 0).r;
    if (!isNearer(nearest, float(kFarDepth))) return 1.0;
    float here = viewDepth(map.depth_terms, nearest);
    vec2 x = vec2(kReach / texel_size, 0.0);
    vec2 rise = vec2(firstStrand(map, texel + x.xy, side, here) -
                         firstStrand(map, texel - x.xy, side, here),
                     firstStrand(map, texel + x.yx, side, here) -
                         firstStrand(map, texel - x.yx, side, here));
    return gainOfSlope(rise / (2.0 * kReach));
}

// Returns the path of light to a point, from one of the light's maps.
LightPath pathFromMap(ShadowReference shadows, ShadowMap map, Receiver receiver) {
    vec4 clip = map.view_projection * vec4(receiver.position, 1.0);
    if (clip.w <= 0.0) return kFreePath;  // behind the light's view
    float w = clip.w;
    clip.xyz /= clip.w;

    float side = shadows.parameters.side;
    float half_width = max(shadows.parameters.softness, 0.5);
    // The whole filter must lie in the map.
    if (any(greaterThan(abs(clip.xy), vec2(1.0 - 2.0 * half_width / side)))) return kFreePath;
    if (isNearer(clip.z, float(kNearDepth))) return kFreePath;
    float z = viewDepth(map.depth_terms, clip.z);
    float texel = map.texel_near + map.texel_slope * z;
    float depth_per_texel = depthPerMetre(map.depth_terms, z) * texel;
    ShadowPoint point;
    point.texel = (0.5 * clip.xy + 0.5) * side;
    point.depth = clip.z;
    point.slope = vec2(0.0);
    point.most_slope = kSteepest * depth_per_texel;
    point.bias = kStrandBias * (half_width + 0.5) * depth_per_texel;
    point.line = vec2(0.0);
    point.line_slope = vec2(0.0);
    point.half_width = 0.0;
    point.own_depth = 0.0;
    point.log_transmittance = log(max(receiver.transmittance, 1e-6));
    // As LocalScattering has it.
    point.log_round_trip = point.log_transmittance + receiver.transmittance - 1.0;
    if (receiver.normal != vec3(0.0)) {
        point.slope = planeSlope(map, clip.xyz, receiver.normal, side);
        vec2 steepness = min(abs(point.slope) / depth_per_texel, vec2(kSteepest));
        float rise = kTurned * (half_width + 0.5) * (1.0 + dot(steepness, steepness));
        point.bias = (kSurfaceBias + rise) * depth_per_texel;
    } else if (kHairShadows == kHairShadowsDeepShadow) {
        vec4 along = map.view_projection * vec4(receiver.tangent, 0.0);
        vec3 per_metre = (along.xyz - clip.xyz * along.w) / w;
        vec2 texels = 0.5 * side * per_metre.xy;
        float squared = max(dot(texels, texels), 1e-12);
        point.line = texels * inversesqrt(squared);
        point.line_slope = per_metre.z * texels / squared;
        point.half_width = 0.5 * receiver.width / texel;
        point.own_depth = kOwnDepth * receiver.width;
    }
    LightPath path = filteredPath(map, point, half_width);
    path.returned *= shadows.parameters.mesh_color;
    if (kHairShadows == kHairShadowsDeepShadow && (map.casters & kHairCasts) != 0u)
        path.multiple_scattering = multipleScattering(map, point.texel, side, texel);
    return path;
}

#ifdef HAIRBENCH_RAYS
#include "shading/traced_shadows.glsl"

// The depth of the first mesh on a map's ray through a point; kFarDepth if there is none.
float meshDepth(ShadowMap map, float side, vec4 clip) {
    if (kMeshShadows == 0u || (map.casters & kMeshesCast) == 0u) return float(kFarDepth);
    vec2 place = clip.xy / clip.w;
    if (clip.w <= 0.0 || any(greaterThan(abs(place), vec2(1.0)))) return float(kFarDepth);
    ivec2 texel = ivec2(min((0.5 * place + 0.5) * side, vec2(side - 1.0)));
    return texelFetch(mesh_depths, ivec2(map.corner) + texel, 0).r;
}

float clipDepth(ShadowMap map, vec4 clip) { return viewDepth(map.depth_terms, clip.z / clip.w); }

// As firstStrand(), on the ray through a point.
float firstTraced(ShadowReference shadows, ShadowMap map, vec4 source, vec3 position, float here) {
    LightRay ray = rayOfLight(source, shadows.parameters.reach, position);
    float t = firstOnRay(shadows, ray, ray.place + shadows.parameters.reach);
    bool is_hit = t < kNowhere;
    vec4 clip =
        map.view_projection * vec4(is_hit ? ray.origin + t * ray.direction : position, 1.0);
    float surface = meshDepth(map, shadows.parameters.side, clip);
    if (isNearer(surface, is_hit ? clip.z / clip.w : float(kFarDepth))) return here;
    return is_hit ? clipDepth(map, clip) : here + kEdge * kReach;
}

// As multipleScattering(), with the first strand on the ray through the point at `first`.
float tracedMultipleScattering(ShadowReference shadows, ShadowMap map, vec4 source, vec3 position,
                               vec3 first) {
    float here = clipDepth(map, map.view_projection * vec4(first, 1.0));
    mat4 rows = transpose(map.view_projection);
    vec3 right = kReach * normalize(rows[0].xyz);
    vec3 up = kReach * normalize(rows[1].xyz);
    vec2 rise = vec2(firstTraced(shadows, map, source, position + right, here) -
                         firstTraced(shadows, map, source, position - right, here),
                     firstTraced(shadows, map, source, position + up, here) -
                         firstTraced(shadows, map, source, position - up, here));
    return gainOfSlope(rise / (2.0 * kReach));
}

// Returns the path of light to a point from one point of the light: by a ray through hair, and
// through a map of the meshes.
LightPath tracedPath(ShadowReference shadows, ShadowMap map, vec4 source, Receiver receiver) {
    LightPath path = kFreePath;
    if (kMeshShadows != 0u) path = pathFromMap(shadows, map, receiver);
    if ((map.casters & kHairCasts) == 0u) return path;
    LightRay ray = rayOfLight(source, shadows.parameters.reach, receiver.position);
    bool is_fibre = receiver.normal == vec3(0.0);
    // Nothing behind a surface matters to it. Behind a strand, light ends at the first mesh.
    float end = ray.place + (is_fibre ? shadows.parameters.reach : 0.0);
    bool has_mesh = false;
    if (is_fibre) {
        vec4 clip = map.view_projection * vec4(receiver.position, 1.0);
        float surface = meshDepth(map, shadows.parameters.side, clip);
        if (isNearer(surface, float(kFarDepth))) {
            float here = clipDepth(map, clip);
            float behind = viewDepth(map.depth_terms, surface) - here;
            has_mesh = behind > 0.0;
            float stretch = source.w == 0.0 ? 1.0 : distance(source.xyz, receiver.position) / here;
            end = clamp(ray.place + behind * stretch, 0.0, end);
        }
    }
    vec3 log_transmittance = log(max(receiver.transmittance, 1e-6));
    MetStrands met = strandsOnRay(shadows, ray, end);
    path.strands = met.before;
    path.direct = met.before == 0.0 ? 1.0 : 0.0;
    path.scattered = met.before == 0.0 ? vec3(0.0) : exp(met.before * log_transmittance);
    path.scatter_count = max(met.before, 1.0);
    path.ended = exp(met.behind * (log_transmittance + receiver.transmittance - 1.0));
    path.returned = has_mesh ? path.ended * shadows.parameters.mesh_color : vec3(0.0);
    if (kModel == kModelDualScattering && is_fibre && met.first < kNowhere)
        path.multiple_scattering = tracedMultipleScattering(
            shadows, map, source, receiver.position, ray.origin + met.first * ray.direction);
    return path;
}
#endif

// Returns the path of light to a point, from one of the light's maps or, instead of its map of
// hair, by a ray.
LightPath pathFrom(ShadowReference shadows, ShadowMap map, uint number, Receiver receiver) {
#ifdef HAIRBENCH_RAYS
    return tracedPath(shadows, map, shadows.parameters.sources[number], receiver);
#else
    return pathFromMap(shadows, map, receiver);
#endif
}

// Averages paths that sample equal parts of a light. The strand terms are weighted by the light
// that meshes let through.
LightPath meanPath(ShadowReference shadows, ShadowMap first, uint light, Receiver receiver) {
    LightPath sum = LightPath(0.0, 0.0, 0.0, vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0);
    for (uint i = 0u; i <= first.further_count; ++i) {
        ShadowMap map = first;
        uint number = i > 0u ? first.further + i - 1u : light;
        if (i > 0u) map = shadows.parameters.maps[number];
        LightPath path = pathFrom(shadows, map, number, receiver);
        float through = path.meshes * dot(path.scattered, vec3(1.0));
        sum.meshes += path.meshes;
        sum.strands += path.meshes * path.strands;
        sum.direct += path.meshes * path.direct;
        sum.scattered += path.meshes * path.scattered;
        sum.scatter_count += through * path.scatter_count;
        sum.ended += path.meshes * path.ended;
        sum.returned += path.meshes * path.returned;
        sum.multiple_scattering += path.meshes * path.multiple_scattering;
    }
    float through = dot(sum.scattered, vec3(1.0));
    sum.scatter_count = through > 1e-6 ? max(sum.scatter_count / through, 1.0) : 1.0;
    float whole = 1.0 / max(sum.meshes, 1e-6);
    sum.strands *= whole;
    sum.direct *= whole;
    sum.scattered *= whole;
    sum.ended *= whole;
    sum.returned *= whole;
    sum.multiple_scattering *= whole;
    sum.meshes /= float(first.further_count + 1u);
    return sum;
}

// Returns the path of light to a point.
LightPath lightPath(PictureParameters picture, uint light, Receiver receiver) {
    if (kMeshShadows == 0 && kHairShadows == kHairShadowsNone) return kFreePath;
    ShadowReference shadows = ShadowReference(picture.shadows);
    ShadowMap map = shadows.parameters.maps[light];
    if (map.casters == 0u) return kFreePath;
    if ((kLightKinds & kSomeSampled) != 0u && map.further_count > 0u)
        return meanPath(shadows, map, light, receiver);
    return pathFrom(shadows, map, light, receiver);
}

// The part of the light that each strand in between lets through, for receivers that are no fibres:
// meshes, and strands of the thesis's models and of Kajiya and Kay's.
vec3 surfaceTransmittance(PictureParameters picture) {
    if (kHairShadows == kHairShadowsNone) return vec3(0.0);
    return ShadowReference(picture.shadows).parameters.transmittance;
}

// The part of the light that reaches a point, for a path with surfaceTransmittance(). For strands
// at random it is exp(-(1 - transmittance) n).
vec3 visibility(LightPath path) { return path.meshes * (path.direct + path.scattered); }

#endif
