#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/fields.h"
#include "hair/groom_settings.h"
#include "hair/simulation_settings.h"
#include "hair/strand_settings.h"

// Every parameter of a case (those of guides, simulation and strands are in groom_settings.h,
// simulation_settings.h and strand_settings.h), with the thesis's values (section 6 there) as
// defaults. A new parameter is a member and a row in the table below its struct; nothing else has
// to be edited.
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

struct LightSettings {
    glm::vec3 position{5.0f, 5.0f, 5.0f};
    glm::vec3 color{1.0f, 1.0f, 1.0f};
};

constexpr auto fields(const LightSettings*) {
    using S = LightSettings;
    return std::tuple{
        Field{"position", &S::position, -1000, 1000, "m", "position of the point light"},
        Field{"color", &S::color, 0, 100, "1", "intensity, display RGB"}};
}

enum class ShadingModel { phong };

// Thesis equations (5) and (6), colours in display RGB as there.
struct ShadingSettings {
    ShadingModel model = ShadingModel::phong;
    glm::vec3 color{0.95f, 0.9f, 0.625f};
    float ambient = 0.5f;
    float diffuse = 0.5f;
    float specular = 0.5f;
    float exponent = 50.0f;
    LightSettings light;
};

constexpr auto fields(const ShadingSettings*) {
    using S = ShadingSettings;
    return std::tuple{
        Choice<S, ShadingModel, 1>{
            "model", &S::model, {{{ShadingModel::phong, "phong"}}}, "how a strand is lit"},
        Field{"color", &S::color, 0, 1, "1", "hair colour, display RGB"},
        Field{"ambient", &S::ambient, 0, 10, "1", "ambient factor"},
        Field{"diffuse", &S::diffuse, 0, 10, "1", "k_d"},
        Field{"specular", &S::specular, 0, 10, "1", "k_s"},
        Field{"exponent", &S::exponent, 1, 10000, "1", "n of the specular term"},
        Group<S, LightSettings>{"light", &S::light, "the light"}};
}

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
};

constexpr auto fields(const OverlaySettings*) {
    using S = OverlaySettings;
    return std::tuple{
        Toggle<S>{"guides", &S::guides, "draw the simulated guides over the hair"},
        Toggle<S>{"root_triangles", &S::root_triangles, "draw the root triangles"}};
}

struct RenderSettings {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::uint32_t msaa = 1;
    std::uint32_t ssaa = 1;
    glm::vec3 background{0.25f, 0.15f, 0.18f};
    bool head = true;
    bool hair = true;
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
        OneOf<S, 2>{"ssaa", &S::ssaa, {1, 2}, "factor", "supersampling along each side"},
        Field{"background", &S::background, 0, 1, "1", "background colour, display RGB"},
        Toggle<S>{"head", &S::head, "draw the mesh that the hair grows on"},
        Toggle<S>{"hair", &S::hair, "draw the strands; without them a frame is its simulation"},
        Group<S, OverlaySettings>{"overlays", &S::overlays, "what is drawn over the hair"}};
}

// ---- Run ----------------------------------------------------------------------------------------

struct RunSettings {
    std::uint32_t warmup = 3;
    std::uint32_t frames = 10;
    float frame_time = 1.0f / 60.0f;
};

constexpr auto fields(const RunSettings*) {
    using S = RunSettings;
    return std::tuple{
        Field{"warmup", &S::warmup, 2, 10000, "count", "frames drawn before measuring"},
        Field{"frames", &S::frames, 1, 1000000, "count", "frames measured in each mode"},
        Field{
            "frame_time", &S::frame_time, 0, 1, "s",
            "simulated time that a frame advances; 0 draws the same instant again"}};
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
