#ifndef HAIRBENCH_STRAND_STRUCTS_H
#define HAIRBENCH_STRAND_STRUCTS_H

// Data that the renderer's host and shader code share. Scalar layout; addresses are device
// addresses.

// Purposes of random numbers (common/random.glsl).
const uint kRootPurpose = 0x524f4f54u;    // positions of strands in their root triangle
const uint kOrderPurpose = 0x4f524452u;   // the order of a groom's strands
const uint kOffsetPurpose = 0x4f464653u;  // the profile of offsets of a strand
const uint kMergedPurpose = 0x4d524744u;  // the hairs that a strand of a coarser level stands for
const uint kExtensionPurpose = 0x45585445u;  // hairRandom() of extension/offset.glsl
const uint kColorPurpose = 0x434f4c52u;  // colours by which a picture distinguishes strands

// Invocations in a work group of strands/frames.comp and strands/turns.comp, and in one of
// strands/evaluate.comp.
const uint kFramesGroupSize = 64u;
const uint kStrandPointsGroupSize = 64u;

// Greatest width of a strand that stands for many hairs, relative to its width without gaps:
// strands/merged_word.glsl.
const float kMostMergedSpread = 1.5f;

// Data for all draws of a picture; one per frame in flight.
struct PictureParameters {
    mat4 view_projection;  // world -> clip, y down; common/depth.glsl
    mat4 head;  // rigid motion: frame of the mesh and root normals -> world
    vec3 eye;  // m
    vec3 lod_eye;  // m: the eye for levels of detail; the camera's, even in a light's picture
    float lod_near;  // m: level 0 up to here
    float lod_far;  // m: maximum level from here on
    float lod_maximum_level;
    float pixel_near;  // m: a rendered pixel's side at the eye; above 0 in parallel projections
    float pixel_slope;  // growth of pixel_near per metre of distance
    vec3 hair_color;  // working colour: display RGB, or linear if there is a tone map
    float strand_variation;  // strands/own_color.glsl
    float tip_lightening;
    float ambient;
    float diffuse;
    float specular;
    float exponent;
    float root_width;  // m
    float tip_width;  // m
    float taper_start;  // part of the taper with root_width, 0 to 1
    float opacity;  // of strands, 0 to 1
    uint light_count;

    Address lights;  // Light [light]
    Address optics;  // HairOptics; read by marschner and dual_scattering
    Address shadows;  // ShadowParameters; read if there are shadows
    Address environment;  // EnvironmentParameters; read if there is an environment
    Address fragments;  // FragmentLists; read if fragments are listed
    Address guides;  // vec4 [guide][vertex], m, root first; w is not read
    Address root_triangles;  // uint [triangle][3], guide indices
    Address root_normals;  // vec3 [guide], unit length, before the head's motion; address 0:
                           // unknown, root triangles are flat
    Address guide_widths;  // float [guide][vertex], m; read if the groom's widths are drawn
    Address bound_strands;  // BoundStrand [strand]; read if the groom's strands are drawn
    Address guide_normals;  // vec3 [guide][vertex], across the guide; read if offsets are drawn
    Address guide_turns;  // vec4 [guide][vertex], unit quaternions: rotation of the guide since
                          // rest; read if residuals are drawn
    Address residuals;  // uvec2 [sample] of all strands: hair/rendering/strand_offsets.h
    Address contacts;  // vec4 [guide][vertex]: w > 0 from the first vertex that touches a body on;
                       // read if the collision rule is on
    Address bodies;  // Bodies; read if they push strands out
    Address root_pattern;  // vec2 [strand], in [0, 1): read if all triangles share one pattern
    Address offsets;  // vec3 [profile][1 + sample + 1], m: see hair/rendering/strand_offsets.h
    Address group_shades;  // float, in [0, 1), of each guide or, if the groom's strands are drawn,
                           // BoundStrand; address 0: there are no groups
    Address root_corrections;  // vec4 [root triangle][strand], `density` per triangle, m: from a
                               // strand's root to its place on the deformed mesh; read if
                               // kSkinnedStrands
    uint offset_profiles;
    uint offset_samples;  // along a strand, from root to tip
    uint vertices_per_guide;
    uint density;  // strands per root triangle at level 0, or all strands of the groom
    uint tessellation;  // segments per guide segment at level 0
    uint patches_per_triangle;  // per guide segment: several if density exceeds the device's
                                // isolines
    uint strands_per_patch;
    uint forced_density;  // most strands that are drawn: those of the forced level, or of level 0
    uint forced_tessellation;
    float forced_level;
    float forced_scale;  // 2^-forced_level
    float least_density_scale;  // for levels by distance: 1 / StrandView::greatest_width_scale
    uint seed;
    float blend;  // 0: mixed strands follow one guide; 1: all three
    Address cluster_levels;  // ClusterLevel [root triangle]; read for levels by cluster
    Address strand_order;  // uint [root triangle][strand], `density` per triangle: the order in
                           // which levels by cluster keep strands; read for them
};

// The level of detail of a cluster, which has the strands of a root triangle: strands/levels.comp.
struct ClusterLevel {
    float strands;  // StrandLod::density
    float pieces;  // drawn segments per guide segment that keep the error; may be fractional
};

// Invocations in a work group of strands/levels.comp.
const uint kLevelsGroupSize = 64u;

// Push constants of strands/levels.comp.
struct LevelsPush {
    Address picture;  // PictureParameters
    Address coverings;  // float [root triangle]: hair/rendering/strand_plan.h
    Address levels;  // ClusterLevel [root triangle]; written
    vec2 slopes;  // half of the picture's width and height at a distance of 1
    float error;  // rendered pixels, over 0
    float reach;  // m; greatest distance by which offsets move points
    float greatest_width;  // m, of strands at level 0
    uint clusters;
};

// A strand of the groom: the weighted mean of its guides plus `offset`, and a residual if residuals
// are known. Without weights it follows only the head.
struct BoundStrand {
    uvec3 guides;
    vec3 weights;  // sum 1; all 0: no guide is used
    vec3 offset;  // m, before the head's motion
    uint first_residual;  // of its samples
    uint residuals;  // samples; at least 2
    float residual_step;  // m: length of one step of a sample's integers
    float residual_reach;  // m: no residual on the strand is longer
    float width;  // factor on the width; read if residuals are drawn
};

// Positions of residual samples on a strand are integers from 0 at the root to this at the tip.
const float kResidualPlaces = 65535.0f;

// The start of a guide's frames before the head's motion: unit vectors along and across it.
struct RootFrame {
    vec3 tangent;
    vec3 normal;
};

// Push constants of strands/frames.comp.
struct FramesPush {
    mat4 head;  // PictureParameters::head
    Address guides;  // vec4 [guide][vertex], m, root first
    Address root_frames;  // RootFrame [guide]
    Address normals;  // vec3 [guide][vertex], unit length, across the guide; written
    uint guide_count;
    uint vertices_per_guide;
};

// Push constants of strands/turns.comp.
struct TurnsPush {
    vec4 head_turn;  // quaternion of PictureParameters::head
    Address guides;  // vec4 [guide][vertex], m, root first
    Address rest_tangents;  // vec3 [guide][vertex], before the head's motion: unit length, or 0 if
                            // the guide has no direction
    Address turns;  // vec4 [guide][vertex]; written
    uint guide_count;
    uint vertices_per_guide;
};

// Attachment of a strand's root to a deforming mesh: groom::SurfaceBinding.
struct CarriedRoot {
    uvec3 corners;  // vertices of the mesh
    vec3 weights;  // of the corners, sum 1
    vec3 offset;  // from the triangle to the root, along the axes of the triangle, m
    vec4 inverse_edges;  // inverse of SurfaceBinding::edges, column by column, 1/m
};

// Invocations in a workgroup of strands/skin.comp.
const uint kSkinGroupSize = 64u;

// Push constants of strands/skin.comp.
struct SkinPush {
    Address picture;  // PictureParameters
    Address roots;  // CarriedRoot [root triangle][strand]; address 0: `found` has the roots
                    // themselves
    Address mesh;  // vec3 [vertex], the deformed mesh, m
    Address found;  // vec4 [root triangle][strand], m; written
    uint count;  // of strands
};

// Push constants of everything that draws strands.
struct StrandPush {
    Address picture;  // PictureParameters
};

// A point of a strand, as strands/evaluate.comp writes it.
struct StrandPointRecord {
    vec3 position;  // m
    float width;  // m; negative: the level of detail does not draw this point
    vec3 tangent;  // d position / d t, t in [0, 1] along the guide segment; m
    float along;  // 0 at the root, 1 at the tip
    float power;  // the strand's colour is the hair's to this power: strands/own_color.glsl
};

// Push constants of strands/evaluate.comp.
struct StrandPointsPush {
    Address picture;  // PictureParameters
    Address records;  // StrandPointRecord [count], written
    uint count;
    uint first;  // number of the first point among all points, [triangle][strand][guide segment][0
                 // .. tessellation]
};

#endif
