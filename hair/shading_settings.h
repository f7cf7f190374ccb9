#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/fields.h"

// How strands are lit: settings.h has the other parameters and says how to add one.
namespace hair {

enum class LightType { point, directional, sphere };

// A light's color is what a white matt surface that faces it shows at reference_distance, or at any
// distance where that is 0, as in the thesis.
struct LightSettings {
    LightType type = LightType::point;
    glm::vec3 position{5.0f, 5.0f, 5.0f};
    glm::vec3 direction{0.0f, -1.0f, 0.0f};
    glm::vec3 color{1.0f, 1.0f, 1.0f};
    float strength = 1.0f;
    float reference_distance = 0.0f;
    float radius = 0.1f;
    bool shadows = true;
};

constexpr auto fields(const LightSettings*) {
    using S = LightSettings;
    return std::tuple{
        Choice<S, LightType, 3>{
            "type",
            &S::type,
            {{{LightType::point, "point"},
              {LightType::directional, "directional"},
              {LightType::sphere, "sphere"}}},
            "point; directional: from infinity; sphere: a point light with a radius"},
        Field{"position", &S::position, -1000, 1000, "m", "of points and spheres"},
        Field{
            "direction", &S::direction, -1, 1, "1", "in which the light of a directional one goes"},
        Field{
            "color", &S::color, 0, 100, "1",
            "what a white matt surface that faces it shows, display RGB"},
        Field{"strength", &S::strength, 0, 10000, "1", "factor of color"},
        Field{
            "reference_distance", &S::reference_distance, 0, 1000, "m",
            "distance at which it has its color and beyond which it is weaker; 0: it is the same "
            "everywhere"},
        Field{"radius", &S::radius, 0, 100, "m", "of spheres"},
        Toggle<S>{"shadows", &S::shadows, "whether what is between stops it: /shading/shadows"}};
}

enum class HairShadows { none, deep_opacity };

struct ShadowSettings {
    bool meshes = false;
    HairShadows hair = HairShadows::none;
    std::uint32_t resolution = 1024;
    float layer_depth = 0.01f;
    float stopped = 0.5f;
    float softness = 1.0f;
};

constexpr auto fields(const ShadowSettings*) {
    using S = ShadowSettings;
    return std::tuple{
        Toggle<S>{"meshes", &S::meshes, "meshes throw shadows on meshes and hair"},
        Choice<S, HairShadows, 2>{
            "hair",
            &S::hair,
            {{{HairShadows::none, "none"}, {HairShadows::deep_opacity, "deep_opacity"}}},
            "what hair throws on hair and meshes; deep_opacity: Yuksel and Keyser 2008"},
        Field{"resolution", &S::resolution, 64, 4096, "px", "side of a light's map"},
        Field{
            "layer_depth", &S::layer_depth, 0.0001, 10, "m",
            "of the first layer of opacity; each of the next is twice as deep"},
        Field{
            "stopped", &S::stopped, 0, 1, "1",
            "of phong, kajiya_kay and meshes: part of the light that a strand stops"},
        Field{
            "softness", &S::softness, 0, 16, "px", "radius in the map over which it is averaged"}};
}

enum class ShadingModel { phong, kajiya_kay, marschner, dual_scattering };
enum class ColorSource { rgb, melanin };

// Hair's color is that of much hair after all scattering.
struct ShadingSettings {
    ShadingModel model = ShadingModel::phong;
    ColorSource color_from = ColorSource::rgb;
    glm::vec3 color{0.95f, 0.9f, 0.625f};
    float eumelanin = 1.3f;
    float pheomelanin = 0.0f;
    float ambient = 0.5f;
    float diffuse = 0.5f;
    float specular = 0.5f;
    float exponent = 50.0f;
    float longitudinal_roughness = 0.3f;
    float azimuthal_roughness = 0.3f;
    float cuticle_tilt = 2.0f;
    float refractive_index = 1.55f;
    float density_factor = 0.7f;
    std::vector<LightSettings> lights{LightSettings{}};
    ShadowSettings shadows;
};

constexpr auto fields(const ShadingSettings*) {
    using S = ShadingSettings;
    return std::tuple{
        Choice<S, ShadingModel, 4>{
            "model",
            &S::model,
            {{{ShadingModel::phong, "phong"},
              {ShadingModel::kajiya_kay, "kajiya_kay"},
              {ShadingModel::marschner, "marschner"},
              {ShadingModel::dual_scattering, "dual_scattering"}}},
            "how a strand is lit; phong: thesis (5), (6); kajiya_kay: Kajiya and Kay 1989; "
            "marschner: light that a fibre reflects and lets through once (R, TT, TRT), d'Eon et "
            "al. 2011 and Chiang et al. 2016; dual_scattering: the same and what other strands "
            "scatter, Zinke et al. 2008"},
        Choice<S, ColorSource, 2>{
            "color_from",
            &S::color_from,
            {{{ColorSource::rgb, "rgb"}, {ColorSource::melanin, "melanin"}}},
            "rgb: color; melanin: the two pigments"},
        Field{"color", &S::color, 0, 1, "1", "hair colour, display RGB"},
        Field{
            "eumelanin", &S::eumelanin, 0, 100, "1",
            "brown pigment; absorption (0.419, 0.697, 1.37) per fibre radius"},
        Field{
            "pheomelanin", &S::pheomelanin, 0, 100, "1",
            "red pigment; absorption (0.187, 0.4, 1.05) per fibre radius"},
        Field{"ambient", &S::ambient, 0, 10, "1", "ambient factor"},
        Field{"diffuse", &S::diffuse, 0, 10, "1", "k_d of phong and kajiya_kay"},
        Field{"specular", &S::specular, 0, 10, "1", "k_s of phong and kajiya_kay"},
        Field{"exponent", &S::exponent, 1, 10000, "1", "n of their specular term"},
        Field{
            "longitudinal_roughness", &S::longitudinal_roughness, 0.05, 1, "1",
            "beta_m of marschner and dual_scattering (Chiang et al. 2016)"},
        Field{
            "azimuthal_roughness", &S::azimuthal_roughness, 0.05, 1, "1",
            "beta_n of marschner and dual_scattering"},
        Field{
            "cuticle_tilt", &S::cuticle_tilt, 0, 10, "deg",
            "alpha: how far cuticle scales stand off; lobes are shifted by -2, 1 and 4 times it"},
        Field{"refractive_index", &S::refractive_index, 1.01, 3, "1", "eta of the fibre"},
        Field{
            "density_factor", &S::density_factor, 0, 1, "1",
            "d_f = d_b of dual_scattering: how much of its surroundings hair fills"},
        List<S, LightSettings>{"lights", &S::lights, 16, "the lights"},
        Group<S, ShadowSettings>{
            "shadows", &S::shadows, "what is between a light and what it lights"}};
}

}  // namespace hair
