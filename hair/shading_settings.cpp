#include "hair/shading_settings.h"

#include "hair/field_rows.h"

namespace hair {

const Table& tableOf(const LightSettings*) {
    using S = LightSettings;
    static const Table table = tableWith<S>(
        {choice(
             "type", &S::type,
             {{LightType::point, "point"},
              {LightType::directional, "directional"},
              {LightType::sphere, "sphere"},
              {LightType::rectangle, "rectangle"}},
             "point; directional: from infinity; sphere: a point light with a radius; rectangle: "
             "shines from one side"),
         number(
             "position", &S::position, -1000, 1000, "m",
             "position of a point light, centre of a sphere or a rectangle"),
         number(
             "direction", &S::direction, -1, 1, "1",
             "direction in which a directional light or a rectangle shines"),
         number(
             "color", &S::color, 0, 100, "1",
             "colour of a white matt surface that faces the light, display RGB"),
         number("strength", &S::strength, 0, 10000, "1", "factor of colour"),
         number(
             "reference_distance", &S::reference_distance, 0, 1000, "m",
             "distance at which the light has its colour and beyond which it is weaker; 0: the "
             "same at any distance"),
         number("radius", &S::radius, 0, 100, "m", "radius of a sphere light"),
         number(
             "angular_radius", &S::angular_radius, 0, 90, "deg",
             "angular radius of a directional light; the sun's is 0.27"),
         number(
             "up", &S::up, -1, 1, "1",
             "direction of a rectangle's height, without its component along `direction`; if "
             "nothing remains, x"),
         number("width", &S::width, 0.0001, 100, "m", "width of a rectangle"),
         number("height", &S::height, 0.0001, 100, "m", "height of a rectangle"),
         toggle("shadows", &S::shadows, "whether the light casts shadows: /shading/shadows"),
         number(
             "shadow_samples", &S::shadow_samples, 1, 64, "count",
             "points of a light with a size, each with its own shadow maps; the light's shadow is "
             "their mean; 1: the shadow of its centre")});
    return table;
}

const Table& tableOf(const ShadowSettings*) {
    using S = ShadowSettings;
    static const Table table = tableWith<S>(
        {toggle("meshes", &S::meshes, "meshes cast shadows on meshes and hair"),
         choice(
             "hair", &S::hair,
             {{HairShadows::none, "none"},
              {HairShadows::deep_opacity, "deep_opacity"},
              {HairShadows::deep_shadow, "deep_shadow"},
              {HairShadows::rays, "rays"}},
             "shadows that hair casts on hair and meshes; deep_opacity: the mean coverage of each "
             "texel (Yuksel and Keyser 2008); deep_shadow: the opacity along a ray through each "
             "texel (Lokovic and Veach 2000); rays: the strands on a ray from the light to each "
             "shaded point; needs ray queries and the back end software or rays"),
         number("resolution", &S::resolution, 64, 4096, "px", "width and height of a light's map"),
         number(
             "layer_depth", &S::layer_depth, 0.0001, 10, "m",
             "depth of the first opacity layer; each layer is twice as deep as the one before it"),
         number(
             "stopped", &S::stopped, 0, 1, "1",
             "fraction of the light that a strand stops, for phong and kajiya_kay, and for meshes "
             "unless the model is dual_scattering"),
         number(
             "softness", &S::softness, 0, 16, "px",
             "radius in a light's map over which its shadow is averaged")});
    return table;
}

const Table& tableOf(const ShadingSettings*) {
    using S = ShadingSettings;
    static const Table table = tableWith<S>(
        {choiceOrFile(
             "model", &S::model,
             {{ShadingModel::phong, "phong"},
              {ShadingModel::kajiya_kay, "kajiya_kay"},
              {ShadingModel::marschner, "marschner"},
              {ShadingModel::dual_scattering, "dual_scattering"}},
             ShadingModel::extension, &S::model_file,
             "how a strand is lit; phong: thesis (5), (6); kajiya_kay: Kajiya and Kay 1989; "
             "marschner: light that a fibre reflects and lets through once (R, TT, TRT), d'Eon et "
             "al. 2011 and Chiang et al. 2016; dual_scattering: marschner and what other strands "
             "scatter, Zinke et al. 2008; a file of GLSL (.glsl), relative to the scene file: "
             "docs/extending.md"),
         parameters(
             "model_parameters", &S::model_parameters,
             "parameters of the file that model names, with the names, ranges and units that it "
             "declares"),
         choice(
             "color_from", &S::color_from,
             {{ColorSource::rgb, "rgb"}, {ColorSource::melanin, "melanin"}},
             "rgb: colour; melanin: the two pigments"),
         number("color", &S::color, 0, 1, "1", "hair colour, display RGB"),
         number(
             "eumelanin", &S::eumelanin, 0, 100, "1",
             "brown pigment; absorption (0.419, 0.697, 1.37) per fibre radius"),
         number(
             "pheomelanin", &S::pheomelanin, 0, 100, "1",
             "red pigment; absorption (0.187, 0.4, 1.05) per fibre radius"),
         number(
             "strand_variation", &S::strand_variation, 0, 0.9, "1",
             "strands differ in colour: each has the hair's colour to a random power, which "
             "differs from 1 by up to this"),
         number(
             "tip_lightening", &S::tip_lightening, 0, 0.9, "1",
             "tips have the hair's colour to a power that is smaller than at the root by this "
             "fraction"),
         number("ambient", &S::ambient, 0, 10, "1", "ambient factor"),
         number("diffuse", &S::diffuse, 0, 10, "1", "k_d of phong and kajiya_kay"),
         number("specular", &S::specular, 0, 10, "1", "k_s of phong and kajiya_kay"),
         number(
             "exponent", &S::exponent, 1, 10000, "1",
             "n, the specular exponent of phong and kajiya_kay"),
         number(
             "longitudinal_roughness", &S::longitudinal_roughness, 0.05, 1, "1",
             "beta_m of marschner and dual_scattering (Chiang et al. 2016)"),
         number(
             "azimuthal_roughness", &S::azimuthal_roughness, 0.05, 1, "1",
             "beta_n of marschner and dual_scattering"),
         number(
             "cuticle_tilt", &S::cuticle_tilt, 0, 10, "deg",
             "alpha: how far cuticle scales stand off; lobes are shifted by -2, 1 and 4 times it"),
         number("refractive_index", &S::refractive_index, 1.01, 3, "1", "eta of the fibre"),
         number(
             "density_factor", &S::density_factor, 0, 1, "1",
             "d of dual_scattering: fraction of the light scattered by a strand that meets other "
             "strands"),
         number(
             "orientation_spread", &S::orientation_spread, 0, 40, "deg",
             "how much the directions of neighbouring strands differ, for dual_scattering: their "
             "standard deviation in each of the two planes along a strand ('hairbench export "
             "--mitsuba' measures it); 0: strands are parallel, as in Zinke et al. 2008"),
         toggle(
             "far_field", &S::far_field,
             "marschner and dual_scattering: average over the part of a strand's width that a "
             "pixel covers, or all of it for thin strands; off: take the point at the pixel's "
             "centre"),
         list("lights", &S::lights, 16, "the lights"),
         number(
             "environment_lights", &S::environment_lights, 0, 48, "count",
             "largest number of lights that replace /render/environment for hair, each for a part "
             "of the directions and with shadows of hair; 0: the irradiance of a matt surface, "
             "times "
             "ambient"),
         toggle(
             "indirect", &S::indirect,
             "meshes get the light that lit hair and meshes send back, from parts of the lights' "
             "shadow maps (Dachsbacher and Stamminger 2005); it needs a tone map and shadows of "
             "meshes"),
         number(
             "skin_scattering", &S::skin_scattering, 0, 10, "1",
             "how far light scatters in the mesh that hair grows on, as a factor of the lengths of "
             "human skin's profile (d'Eon and Luebke 2007), by the mesh's curvature (Penner 2011); "
             "it needs a tone map; 0: it does not"),
         group("shadows", &S::shadows, "shadows of meshes and hair")});
    return table;
}

}  // namespace hair
