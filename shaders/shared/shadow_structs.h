#ifndef HAIRBENCH_SHADOW_STRUCTS_H
#define HAIRBENCH_SHADOW_STRUCTS_H

const uint kMostLights = 64u;  // the scene's lights, then those of an environment
const uint kMostFurtherMaps = 128u;  // of lights with several maps
const uint kMostMaps = 192u;

// Shadow casters in a map.
const uint kMeshesCast = 1u;
const uint kHairCasts = 2u;

// A light's view in its square part of the shadow atlases.
struct ShadowMap {
    mat4 view_projection;  // world -> clip space of the light
    vec4 depth_terms;  // (a, b, c, d): depth = (a z + b) / (c z + d), z metres along the view
    vec2 corner;  // corner of the light's part of the atlas, texels
    float texel_near;  // m: a texel's side at the light; above 0 in parallel projections
    float texel_slope;  // growth of texel_near per metre along the view
    float layer_depth;  // m: see shadows/layers.glsl
    uint ends_at_meshes;  // 1: strands behind a mesh are not counted
    uint casters;  // kMeshesCast | kHairCasts; 0: the light throws no shadows
    uint further;  // first of the light's other maps in ShadowParameters::maps
    uint further_count;
};

// The shadows of a picture, for everything that is lit.
struct ShadowParameters {
    ShadowMap maps[kMostMaps];  // [light]; from kMostLights on, further maps of some lights
    float side;  // of one part of the atlas, texels
    float softness;  // texels
    // Part of the light that each strand lets through to meshes, and to strands of opaque models
    vec3 transmittance;
    vec3 mesh_color;  // light that meshes send back, linear; in display RGB if light is not linear
    // The members below are for hair's shadows by rays.
    vec4 sources[kMostMaps];  // [map]: the light's position, m, and 1, or the direction to it and 0
    float reach;  // m: no hair is farther from a point that is lit
    Address structure;  // the acceleration structure of StrandBox
    Address points;  // PointsPush::points
    Address boxes;  // StrandBox
};

// Sums of opacity in a map that is drawn in compute are whole numbers of this part of a strand, so
// that they do not depend on the order of strands. A layer of a texel has room for 65,535 strands.
const float kCoverageUnit = 1.0 / 65536.0;

// Push constants of shadows/raster.comp and shadows/store.comp, for one light's map.
struct ShadowRasterPush {
    Address picture;  // PictureParameters of the light
    Address points;  // PointsPush::points
    Address pieces;  // PointsPush::pieces
    Address depths;  // uint [row][column]: bits of the nearest strand's depth, 0 without strands
    Address layers;  // uvec4 [row][column]: what each layer adds to opacity, in kCoverageUnit
    Address large;  // uint: the number of large pieces, which may exceed kMostLargePieces, and them
    uint width;  // of the map, texels
    uint height;
    uint strands;
    uint choice;  // 0: finds depths, 1: adds to layers
};

#endif
