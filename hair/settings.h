#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/extension.h"
#include "hair/groom_settings.h"
#include "hair/shading_settings.h"
#include "hair/simulation_settings.h"

// All parameters of a case, with the thesis's values (its section 6) as defaults. Parameters of
// guides, simulation and light are in groom_settings.h, simulation_settings.h and
// shading_settings.h. A new parameter needs a member here and a row in the struct's table in
// settings.cpp, and nothing else. fields.h is for code that walks the tables.
namespace hair {

class Table;

// ---- Making strands from guides -----------------------------------------------------------------

enum class Backend {
    automatic,
    tessellation,
    pulling_geometry,
    lines,
    pulling,
    expanded,
    mesh,
    software,
    rays
};
// Returns the name of a backend in scenes.
const char* backendName(Backend backend);

// How the back end `rays` brings its acceleration structure up to date in each frame.
enum class RaysUpdate { build, refit };
// The shape of a strand's pieces that rays meet.
enum class RaysGeometry {
    triangles,  // of the quads that the other back ends draw
    boxes,  // round, within a box
};

struct RaysSettings {
    RaysGeometry geometry = RaysGeometry::triangles;
    RaysUpdate update = RaysUpdate::build;
};

const Table& tableOf(const RaysSettings*);

enum class Interpolation { multi, single, mixed };
enum class StrandCollision { none, push_out };
enum class Randomness { hashed, thesis };
// extension: of the file that StrandSettings::curve_file names.
enum class Curve { bspline, bspline_unpinned, catmull_rom, extension };
enum class Taper { strand, segment };
enum class Submission { instanced, batched };
enum class StrandSource { root_triangles, groom };
enum class WidthSource { scene, groom };

// Curls of interpolated strands, in addition to their guides' curls: thesis 2.3.8.2.
struct StrandCurlSettings {
    float radius = 0.0f;
    float frequency = 60.0f;
    float frequency_variation = 0.2f;
    float start = 0.15f;
};

const Table& tableOf(const StrandCurlSettings*);

// Random offsets, computed once, of a fraction of the strands: thesis 2.3.8.3.
struct StrandVariationSettings {
    float amplitude = 0.0f;
    float frequency = 20.0f;
    float share = 0.5f;
    float start = 0.1f;
};

const Table& tableOf(const StrandVariationSettings*);

struct StrandSettings {
    Backend backend = Backend::automatic;
    StrandSource source = StrandSource::root_triangles;
    Interpolation interpolation = Interpolation::multi;
    float blend = 0.5f;
    bool collision_rule = false;
    StrandCollision collision = StrandCollision::none;
    Randomness randomness = Randomness::hashed;
    std::uint32_t density = 64;
    std::uint32_t tessellation = 4;
    WidthSource width = WidthSource::scene;
    float root_width = 0.002f;
    float tip_width = 0.0005f;
    StrandCurlSettings curl;
    StrandVariationSettings variation;
    std::string offsets;
    std::string offset_function;
    ExtensionParameters offset_parameters;
    float opacity = 1.0f;
    std::string texture;
    Curve curve = Curve::bspline;
    std::string curve_file;
    ExtensionParameters curve_parameters;
    Taper taper = Taper::strand;
    float taper_start = 0.0f;
    Submission submission = Submission::instanced;
    RaysSettings rays;
};

const Table& tableOf(const StrandSettings*);

// ---- Level of detail ----------------------------------------------------------------------------

// Level of detail: at level L, density and tessellation are divided by 2^L, and the width grows to
// keep the covered area (thesis 2.3.8.1).
enum class LodMode { forced, distance, cluster };

// How a strand that stands for several is drawn: as those hairs, with gaps, or as one wide strip.
enum class MergedStrands { hairs, strip };

struct LodSettings {
    LodMode mode = LodMode::forced;
    float level = 0.0f;
    float near_distance = 0.5f;
    float far_distance = 8.0f;
    float maximum_level = 4.0f;
    float error = 1.0f;
    MergedStrands merged = MergedStrands::hairs;
};

const Table& tableOf(const LodSettings*);

// ---- Copies -------------------------------------------------------------------------------------

// How copies of the head move. shared: one simulation moves all of them; own: each has a simulation
// with its own wind and its own time in the head's motion.
enum class CopyMotion { shared, own };

// Several heads with the same hair: copyOffsets().
struct CopySettings {
    std::uint32_t count = 1;
    float spacing = 0.5f;
    CopyMotion motion = CopyMotion::shared;
    float delay = 0.37f;
};

const Table& tableOf(const CopySettings*);

// Number of copies that move differently.
inline std::uint32_t motions(const CopySettings& settings) {
    return settings.motion == CopyMotion::own ? settings.count : 1;
}

// Returns where the copies stand, m. The first is at the origin. Rows of equal length go back along
// -z, and each is filled from its middle, right and left in turn. A full grid is as wide as deep.
std::vector<glm::vec3> copyOffsets(const CopySettings& settings);

// ---- Picture ------------------------------------------------------------------------------------

struct CameraSettings {
    glm::vec3 position{0.0f, 0.0f, 0.5f};
    glm::vec3 target{0.0f, 0.0f, 0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float field_of_view = 100.0f;
    float near_plane = 0.01f;
    float far_plane = 100.0f;
};

const Table& tableOf(const CameraSettings*);

struct OverlaySettings {
    bool guides = false;
    bool root_triangles = false;
    bool bodies = false;
};

const Table& tableOf(const OverlaySettings*);

// A mesh besides the head. It does not move.
struct MeshSettings {
    std::string file;
    glm::vec3 translation{0.0f};
    glm::vec3 rotation{0.0f};
    float scale = 1.0f;
};

const Table& tableOf(const MeshSettings*);

enum class Coverage { sampled, analytic };
enum class Transparency { none, alpha_to_coverage, weighted_blended, fragment_list };
enum class ToneMap { none, srgb, aces, agx };
enum class Show { shading, tangents, normals, lod, strands, groups, shadow, overdraw, density };

struct RenderSettings {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t msaa = 1;
    std::uint32_t ssaa = 1;
    Coverage coverage = Coverage::sampled;
    Transparency transparency = Transparency::none;
    std::uint32_t list_length = 16;
    ToneMap tone_map = ToneMap::none;
    float exposure = 0.0f;
    glm::vec3 background{0.25f, 0.15f, 0.18f};
    std::string environment;
    float environment_strength = 1.0f;
    float environment_turn = 0.0f;
    bool head = true;
    float scalp_tint = 1.0f;
    std::vector<MeshSettings> meshes;
    bool hair = true;
    Show show = Show::shading;
    OverlaySettings overlays;
};

const Table& tableOf(const RenderSettings*);

// ---- Run ----------------------------------------------------------------------------------------

enum class Clocks { as_found, locked, free };

// Quantities of guides over time: hair/simulation/probes.h.
struct ProbeSettings {
    bool tip_displacement = false;
    bool groom_distance = false;
    bool length_error = false;
    bool energy = false;
    bool contact = false;
    bool speed = false;
    bool bending = false;
    bool torsion = false;
    bool momentum = false;
    std::string reference;
    std::uint32_t first_guide = 0;
    std::uint32_t guides = 0;
};

const Table& tableOf(const ProbeSettings*);

struct RunSettings {
    std::uint32_t warmup = 3;
    std::uint32_t frames = 10;
    float precision = 0.01f;
    float max_time = 10.0f;
    float case_timeout = 0.0f;
    float warmup_time = 0.1f;
    float round_time = 0.25f;
    float frame_time = 1.0f / 60.0f;
    bool interpolate = false;
    std::uint32_t frames_in_flight = 2;
    bool overlapped_stamps = false;
    bool async_compute = false;
    Clocks clocks = Clocks::as_found;
    std::string busy_pass;
    std::uint32_t busy_work = 0;
    std::string reference;
    bool compare_backends = false;
    ProbeSettings probes;
};

const Table& tableOf(const RunSettings*);

// All parameters of a case: the members of a scene file except its sweep.
struct Settings {
    std::string description;
    std::uint32_t seed = 1;
    GroomSettings groom;
    SimulationSettings simulation;
    StrandSettings strands;
    LodSettings lod;
    CopySettings copies;
    ShadingSettings shading;
    CameraSettings camera;
    RenderSettings render;
    RunSettings run;
};

const Table& tableOf(const Settings*);

}  // namespace hair
