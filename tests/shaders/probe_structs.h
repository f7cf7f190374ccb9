#ifndef HAIRBENCH_PROBE_STRUCTS_H
#define HAIRBENCH_PROBE_STRUCTS_H

// Inputs and outputs of the tests' shaders. Include shared/distance_field_structs.h first.

// Input and output of probe_distance.comp.
struct DistanceProbe {
    vec3 position;  // m
    vec3 before;  // m: friction holds it here
    float distance;  // m; written
    vec3 gradient;  // of the distance; written
    vec3 pushed;  // m: position after contact; written
};

// Push constants of probe_distance.comp.
struct ProbeDistancePush {
    DistanceField field;
    Address probes;  // DistanceProbe
    uint count;
    float margin;  // m
    float friction;  // Coulomb's coefficient
};

// Push constants of probe_environment.comp.
struct EnvironmentProbePush {
    Address environment;  // EnvironmentParameters
    Address directions;  // vec3 [direction], unit length
    Address radiance;  // vec3 [direction], written: radiance from there
    Address light;  // vec3 [direction], written: light on surfaces that face there
    uint count;
};

// Input and output of probe_fiber.comp.
struct FiberProbe {
    vec3 to_eye;
    float h;
    vec3 to_light;
    float strands;
    float ended;  // LightPath::ended, for all channels
    float returned;  // LightPath::returned
    vec3 bsdf;  // f |cos theta_i|; written
    vec3 dual_scattering;  // written
};

// Push constants of probe_fiber.comp.
struct ProbeFiberPush {
    Address optics;  // HairOptics
    Address probes;  // FiberProbe
    uint count;
};

// Input and output of probe_models.comp: a point and a light.
struct ModelProbe {
    vec3 position;  // m
    uint light;
    vec3 normal;  // unit length
    float exponent;
    vec3 tangent;  // unit length
    vec3 to_eye;  // unit length
    // The shader writes to_light and all members below it.
    vec3 to_light;  // unit length
    vec3 color;
    float angular_radius;  // rad
    float matt;  // mattResponse()
    float phong_diffuse;
    float phong_specular;
    float kajiya_kay_diffuse;
    float kajiya_kay_specular;
    float widened_exponent;
};

// Push constants of probe_models.comp.
struct ProbeModelsPush {
    Address lights;  // Light
    Address probes;  // ModelProbe
    uint count;
};

// Input and output of probe_rectangle.comp.
struct RectangleProbe {
    vec3 base_color;
    float metallic;
    float roughness;
    vec3 normal;
    vec3 to_eye;
    vec3 corners[4];  // m, as in LightSample
    vec3 diffuse;  // radiance to the eye, of a rectangle of radiance 1; written
    vec3 glossy;  // written
};

// Push constants of probe_rectangle.comp.
struct RectangleProbePush {
    Address probes;  // RectangleProbe [probe]
    uint count;
};

// Input and output of probe_round_cone.comp: a ray and a piece of a strand.
struct RoundConeProbe {
    vec3 origin;  // m
    vec3 direction;  // unit length
    vec3 from;  // m
    vec3 to;
    float from_radius;  // m
    float to_radius;
    float enters;  // m; written, above `leaves` if the ray misses the piece
    float leaves;
};

// Push constants of probe_round_cone.comp.
struct RoundConeProbePush {
    Address probes;  // RoundConeProbe [probe]
    uint count;
};

// Sample positions of strands/software/samples.glsl. probe_software.comp writes them to
// SoftwarePush::colors.
struct SamplePlaces {
    vec2 places[8];  // px, for each sample
    uint row_samples[8];  // sample of each row
    float row_places[8];  // px, along the row
    uint column_samples[8];
    float column_places[8];
};

// An end of a quad of probe_software.comp: members of ScreenEnd.
struct QuadProbeEnd {
    vec2 place;  // px
    vec2 side;
    float depth;
    float side_depth;
};

// A quad that probe_software.comp covers: SoftwarePush::list has `strands` of them.
struct QuadProbe {
    QuadProbeEnd from;
    QuadProbeEnd to;
    uint number;  // of the piece
};

// A query point of probe_shadows.frag.
struct ShadowProbe {
    vec3 position;  // m
    uint light;
    vec3 normal;  // of the surface, unit length; 0: of a strand
    vec3 tangent;  // of the strand, unit length
    float width;  // m, of the strand
};

// Push constants of probe_shadows.frag.
struct ShadowProbePush {
    Address picture;  // PictureParameters
    Address probes;  // ShadowProbe [column]
    uint count;
};

// A point of a strand, and its shading.
struct StrandProbe {
    vec3 tangent;  // unit length
    vec3 to_eye;  // unit length
    float across;
    vec3 normal;  // cylinderNormal(); written
    vec3 color;  // working colours; written
};

// Push constants of probe_strand.comp.
struct ProbeStrandPush {
    Address picture;  // PictureParameters
    Address probes;  // StrandProbe
    uint count;
};

// Input and output of probe_surface.comp.
struct SurfaceProbe {
    vec3 base_color;
    float metallic;
    float roughness;
    vec3 normal;
    vec3 to_eye;
    vec3 to_light;
    vec3 f;  // 1/sr, written
};

// Push constants of probe_surface.comp.
struct SurfaceProbePush {
    Address probes;  // SurfaceProbe [probe]
    uint count;
};

#endif
