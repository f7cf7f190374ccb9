#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/fields.h"
#include "hair/groom_settings.h"
#include "hair/shading_settings.h"
#include "hair/simulation_settings.h"
#include "hair/strand_settings.h"

// Every parameter of a case (those of guides, simulation, strands and light are in
// groom_settings.h, simulation_settings.h, strand_settings.h and shading_settings.h), with the
// thesis's values (section 6 there) as defaults. A new parameter is a member and a row in the table
// below its struct; nothing else has to be edited.
namespace hair {

// ---- Level of detail ----------------------------------------------------------------------------

// Level of detail: at level L density and tessellation are divided by 2^L and the width grows so
// that the covered area is kept (thesis 2.3.8.1).
enum class LodMode { forced, distance };

struct LodSettings {
    LodMode mode = LodMode::forced;
    float level = 0.0f;
    float near_distance = 0.5f;
    float far_distance = 8.0f;
    float maximum_level = 4.0f;
};

constexpr auto fields(const LodSettings*) {
    using S = LodSettings;
    return std::tuple{
        Choice<S, LodMode, 2>{
            "mode",
            &S::mode,
            {{{LodMode::forced, "forced"}, {LodMode::distance, "distance"}}},
            "forced: `level` everywhere; distance: by distance from the camera"},
        Field{"level", &S::level, 0, 8, "1", "forced level; may be fractional"},
        Field{
            "near_distance", &S::near_distance, 0.001, 1000, "m",
            "distance up to which level 0 is drawn"},
        Field{
            "far_distance", &S::far_distance, 0.001, 1000, "m",
            "distance at which maximum_level is reached"},
        Field{"maximum_level", &S::maximum_level, 0, 8, "1", "level at far_distance and beyond"}};
}

// ---- Picture ------------------------------------------------------------------------------------

struct CameraSettings {
    glm::vec3 position{0.0f, 0.0f, 0.5f};
    glm::vec3 target{0.0f, 0.0f, 0.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float field_of_view = 100.0f;
    float near_plane = 0.01f;
    float far_plane = 100.0f;
};

constexpr auto fields(const CameraSettings*) {
    using S = CameraSettings;
    return std::tuple{
        Field{"position", &S::position, -1000, 1000, "m", "eye"},
        Field{"target", &S::target, -1000, 1000, "m", "point looked at"},
        Field{"up", &S::up, -1, 1, "1", "up direction"},
        Field{"field_of_view", &S::field_of_view, 1, 170, "deg", "vertical field of view"},
        Field{"near_plane", &S::near_plane, 0.0001, 100, "m", "near plane"},
        Field{"far_plane", &S::far_plane, 0.001, 10000, "m", "far plane"}};
}

struct OverlaySettings {
    bool guides = false;
    bool root_triangles = false;
    bool bodies = false;
};

constexpr auto fields(const OverlaySettings*) {
    using S = OverlaySettings;
    return std::tuple{
        Toggle<S>{"guides", &S::guides, "draw the simulated guides over the hair"},
        Toggle<S>{"root_triangles", &S::root_triangles, "draw the root triangles"},
        Toggle<S>{"bodies", &S::bodies, "draw the bodies that hair collides with"}};
}

// A mesh beside the head; it does not move.
struct MeshSettings {
    std::string file;
    glm::vec3 translation{0.0f};
    glm::vec3 rotation{0.0f};
    float scale = 1.0f;
};

constexpr auto fields(const MeshSettings*) {
    using S = MeshSettings;
    return std::tuple{
        FileName<S>{{"file", &S::file, "mesh (.gltf, .glb, .obj, ...), relative to the scene"}},
        Field{"translation", &S::translation, -1000, 1000, "m", "where its origin is"},
        Field{
            "rotation", &S::rotation, -360, 360, "deg",
            "about x, then y, then z; before it is moved"},
        Field{"scale", &S::scale, 0.0001, 10000, "1", "size; before it is turned"}};
}

enum class Coverage { sampled, analytic };
enum class Transparency { none, alpha_to_coverage, weighted_blended, fragment_list };
enum class ToneMap { none, srgb, aces, agx };
enum class Show { shading, tangents, normals, lod, strands };

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
    std::vector<MeshSettings> meshes;
    bool hair = true;
    Show show = Show::shading;
    OverlaySettings overlays;
};

constexpr auto fields(const RenderSettings*) {
    using S = RenderSettings;
    return std::tuple{
        Field{"width", &S::width, 1, 8192, "px", "width of the picture"},
        Field{"height", &S::height, 1, 8192, "px", "height of the picture"},
        OneOf<S, 4>{
            "msaa",
            &S::msaa,
            {1, 2, 4, 8},
            "samples",
            "multisampling; a count the device lacks is skipped"},
        OneOf<S, 3>{"ssaa", &S::ssaa, {1, 2, 4}, "factor", "supersampling along each side"},
        Choice<S, Coverage, 2>{
            "coverage",
            &S::coverage,
            {{{Coverage::sampled, "sampled"}, {Coverage::analytic, "analytic"}}},
            "sampled: a strand is where samples hit it; analytic: a strand thinner than a pixel is "
            "as wide as one and as much fainter, which needs a transparency"},
        Choice<S, Transparency, 4>{
            "transparency",
            &S::transparency,
            {{{Transparency::none, "none"},
              {Transparency::alpha_to_coverage, "alpha_to_coverage"},
              {Transparency::weighted_blended, "weighted_blended"},
              {Transparency::fragment_list, "fragment_list"}}},
            "what opacity does; none: nothing; alpha_to_coverage: it covers as many samples, which "
            "needs msaa; weighted_blended: McGuire and Bavoil 2013; fragment_list: fragments "
            "sorted per pixel"},
        Field{
            "list_length", &S::list_length, 1, 256, "count",
            "of fragment_list: fragments that there is room for, per rendered pixel in the mean"},
        Choice<S, ToneMap, 4>{
            "tone_map",
            &S::tone_map,
            {{{ToneMap::none, "none"},
              {ToneMap::srgb, "srgb"},
              {ToneMap::aces, "aces"},
              {ToneMap::agx, "agx"}}},
            "none: light is added up in display RGB, as in the thesis; the others add up linear "
            "light; srgb: clipped; aces, agx: film-like"},
        Field{"exposure", &S::exposure, -20, 20, "stops", "of linear light, before the tone map"},
        Field{"background", &S::background, 0, 1, "1", "background colour, display RGB"},
        FileName<S>{
            {"environment", &S::environment,
             "light from all around and background: latitude-longitude picture (.exr, .hdr), "
             "relative to the scene file; empty: none"}},
        Field{
            "environment_strength", &S::environment_strength, 0, 1000, "1",
            "factor of the environment's light"},
        Field{
            "environment_turn", &S::environment_turn, -360, 360, "deg",
            "of the environment about +y"},
        Toggle<S>{"head", &S::head, "draw the mesh that the hair grows on"},
        List<S, MeshSettings>{"meshes", &S::meshes, 16, "other meshes"},
        Toggle<S>{"hair", &S::hair, "draw the strands; without them a frame is its simulation"},
        Choice<S, Show, 5>{
            "show",
            &S::show,
            {{{Show::shading, "shading"},
              {Show::tangents, "tangents"},
              {Show::normals, "normals"},
              {Show::lod, "lod"},
              {Show::strands, "strands"}}},
            "what colours strands: light; directions along and across them as RGB; the level of "
            "detail from blue to red; or a colour of each strand's own"},
        Group<S, OverlaySettings>{"overlays", &S::overlays, "what is drawn over the hair"}};
}

// ---- Run ----------------------------------------------------------------------------------------

struct RunSettings {
    std::uint32_t warmup = 3;
    std::uint32_t frames = 10;
    float precision = 0.01f;
    float max_time = 10.0f;
    float frame_time = 1.0f / 60.0f;
    std::string busy_pass;
    std::uint32_t busy_work = 0;
    std::string reference;
};

constexpr auto fields(const RunSettings*) {
    using S = RunSettings;
    return std::tuple{
        Field{"warmup", &S::warmup, 2, 10000, "count", "frames drawn before measuring"},
        Field{
            "frames", &S::frames, 1, 1000000, "count",
            "frames of a round: each round of a mode plays these ones"},
        Field{
            "precision", &S::precision, 0, 1, "1",
            "rounds are played until half the interval of the frame time's median is this share of "
            "it; 0: for max_time"},
        Field{
            "max_time", &S::max_time, 0, 86400, "s",
            "no more rounds are begun in a mode after so long; 0: one round"},
        Field{
            "frame_time", &S::frame_time, 0, 1, "s",
            "simulated time that a frame advances; 0 draws the same instant again"},
        Text<S>{
            "busy_pass", &S::busy_pass,
            "pass to slow down, to see whether a comparison finds it; empty: none"},
        Field{
            "busy_work", &S::busy_work, 0, 1000000000, "count",
            "steps of work that nobody needs, added to each busy_pass"},
        FileName<S>{
            {"reference", &S::reference,
             "picture (.exr, .png) that the last frame is compared with, relative to the scene "
             "file; empty: none"}}};
}

// Everything a case needs: the members of a scene file but its sweep.
struct Settings {
    std::string description;
    std::uint32_t seed = 1;
    GroomSettings groom;
    SimulationSettings simulation;
    StrandSettings strands;
    LodSettings lod;
    ShadingSettings shading;
    CameraSettings camera;
    RenderSettings render;
    RunSettings run;
};

constexpr auto fields(const Settings*) {
    using S = Settings;
    return std::tuple{
        Text<S>{"description", &S::description, "what the scene shows, for people"},
        Field{"seed", &S::seed, 0, 4294967295.0, "1", "seed of every random number"},
        Group<S, GroomSettings>{"groom", &S::groom, "the guides"},
        Group<S, SimulationSettings>{"simulation", &S::simulation, "how the guides move"},
        Group<S, StrandSettings>{"strands", &S::strands, "how strands are made from guides"},
        Group<S, LodSettings>{"lod", &S::lod, "level of detail"},
        Group<S, ShadingSettings>{"shading", &S::shading, "how strands are lit"},
        Group<S, CameraSettings>{"camera", &S::camera, "the camera"},
        Group<S, RenderSettings>{"render", &S::render, "the picture"},
        Group<S, RunSettings>{"run", &S::run, "what is measured"}};
}

}  // namespace hair
