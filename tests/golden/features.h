#pragma once

#include <vector>

#include "tests/rendering/pictures.h"

// Features with golden pictures, and the settings that show them.
namespace hair {

struct Feature {
    const char* name;  // its picture is tests/golden/pictures/<name>.png
    void (*show)(Settings&);
    // Another feature. The pictures must differ, otherwise this feature has no visible effect.
    const char* differs_from = "plain";
};

// Returns settings for a small close-up of the thesis's head of hair.
inline Settings plainSettings() {
    Settings settings = rendering::thesisAtRest();
    settings.simulation.solver = Solver::none;
    settings.groom.grow.droop = 10.0f;
    settings.strands.density = 24;
    settings.camera.position = {0.24f, 0.08f, 0.38f};
    settings.camera.target = {0.0f, -0.02f, 0.0f};
    settings.camera.field_of_view = 40.0f;
    settings.render.width = 160;
    settings.render.height = 128;
    return settings;
}

// Adds linear light from the side, with shadows.
inline void lit(Settings& settings) {
    settings.render.tone_map = ToneMap::srgb;
    settings.render.background = {0.05f, 0.05f, 0.06f};
    settings.shading.color = {0.6f, 0.4f, 0.25f};
    settings.shading.ambient = 0.1f;
    settings.shading.lights[0].position = {2.0f, 3.0f, 1.0f};
    settings.shading.shadows.meshes = true;
    settings.shading.shadows.hair = HairShadows::deep_opacity;
    settings.shading.shadows.resolution = 256;
}

inline const std::vector<Feature>& features() {
    static const std::vector<Feature> kFeatures{
        {"plain", [](Settings&) {}, nullptr},
        {"single", [](Settings& s) { s.strands.interpolation = Interpolation::single; }},
        {"mixed", [](Settings& s) { s.strands.interpolation = Interpolation::mixed; }, "single"},
        {"catmull_rom", [](Settings& s) { s.strands.curve = Curve::catmull_rom; }},
        {"curl",
         [](Settings& s) {
             s.strands.curl.radius = 0.006f;
             s.strands.tessellation = 12;
         }},
        {"variation",
         [](Settings& s) {
             s.strands.variation.amplitude = 0.008f;
             s.strands.variation.share = 0.8f;
         }},
        {"own_colors",
         [](Settings& s) {
             s.shading.strand_variation = 0.7f;
             s.shading.tip_lightening = 0.5f;
         }},
        {"grown_strands",
         [](Settings& s) {
             s.groom.grow.strands = 4000;
             s.groom.style.clump = {.strength = 0.8f, .variation = 0.5f, .levels = 2};
             s.groom.style.wave = {
                 .amplitude = 0.006f, .phase_variation = 1.0f, .spacing = 0.02f, .drift = 0.3f};
             s.groom.style.flyaways = {.share = 0.1f, .reach = 0.03f};
             s.strands.source = StrandSource::groom;
             s.strands.root_width = 0.001f;
         }},
        {"vellus",
         [](Settings& s) {
             s.groom.grow.strands = 4000;
             s.groom.grow.length = 0.02f;
             s.groom.grow.vellus = {
                 .share = 0.5f, .length = 0.03f, .width = 0.0005f, .band = 0.03f};
             s.groom.fixed = HAIRBENCH_SOURCE_DIR "/scenes/assets/brows.npz";
             s.strands.source = StrandSource::groom;
             s.strands.root_width = 0.001f;
             s.render.scalp_tint = 0.0f;
         },
         "grown_strands"},
        {"braid",
         [](Settings& s) {
             s.groom.grow.strands = 4000;
             s.groom.grow.vertices = 60;
             s.groom.grow.length = 0.5f;
             s.groom.style.braid = {.pitch = 0.06f, .width = 0.045f, .length = 0.16f};
             s.strands.source = StrandSource::groom;
             s.strands.root_width = 0.001f;
             s.camera.position = {-0.24f, 0.0f, -0.5f};
             s.camera.target = {0.0f, -0.1f, 0.0f};
         }},
        {"taper",
         [](Settings& s) {
             s.strands.root_width = 0.004f;
             s.strands.tip_width = 0.0f;
             s.strands.taper_start = 0.5f;
         }},
        {"lod",
         [](Settings& s) {
             s.lod.level = 1.6f;
             s.lod.merged = MergedStrands::strip;
         }},
        {"lod_hairs", [](Settings& s) { s.lod.level = 1.6f; }, "lod"},
        {"lod_clusters", [](Settings& s) { s.lod = {.mode = LodMode::cluster, .error = 12.0f}; }},
        {"msaa", [](Settings& s) { s.render.msaa = 4; }},
        {"ssaa", [](Settings& s) { s.render.ssaa = 2; }},
        {"ssaa4", [](Settings& s) { s.render.ssaa = 4; }},
        {"msaa_ssaa",
         [](Settings& s) {
             s.render.msaa = 4;
             s.render.ssaa = 2;
         }},
        {"alpha_to_coverage",
         [](Settings& s) {
             s.render.msaa = 4;
             s.render.transparency = Transparency::alpha_to_coverage;
             s.strands.opacity = 0.5f;
         },
         "msaa"},
        {"weighted_blended",
         [](Settings& s) {
             s.render.transparency = Transparency::weighted_blended;
             s.render.coverage = Coverage::analytic;
             s.strands.opacity = 0.6f;
         }},
        {"fragment_list",
         [](Settings& s) {
             s.render.transparency = Transparency::fragment_list;
             s.render.coverage = Coverage::analytic;
             s.render.list_length = 64;
         }},
        {"lit", lit},
        {"kajiya_kay",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::kajiya_kay;
         },
         "lit"},
        {"marschner",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::marschner;
         },
         "kajiya_kay"},
        {"dual_scattering",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::dual_scattering;
         },
         "marschner"},
        {"deep_shadow",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::dual_scattering;
             s.shading.shadows.hair = HairShadows::deep_shadow;
         },
         "dual_scattering"},
        {"melanin",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::dual_scattering;
             s.shading.color_from = ColorSource::melanin;
             s.shading.pheomelanin = 0.8f;
             s.shading.eumelanin = 0.2f;
         },
         "dual_scattering"},
        {"no_shadows",
         [](Settings& s) {
             lit(s);
             s.shading.shadows = {};
         },
         "lit"},
        {"lights",
         [](Settings& s) {
             lit(s);
             s.shading.lights = {
                 {.type = LightType::sphere,
                  .position = {-0.5f, 0.3f, 0.3f},
                  .color = {1.0f, 0.5f, 0.2f},
                  .radius = 0.2f},
                 {.type = LightType::directional,
                  .direction = {-0.5f, -0.4f, -0.8f},
                  .color = {0.2f, 0.4f, 1.0f}},
                 {.position = {0.3f, 0.3f, -0.2f}, .reference_distance = 0.3f}};
         },
         "lit"},
        {"rectangle",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::marschner;
             s.shading.lights = {
                 {.type = LightType::rectangle,
                  .position = {0.25f, 0.2f, 0.3f},
                  .direction = {-0.25f, -0.2f, -0.3f},
                  .reference_distance = 0.4f,
                  .width = 0.1f,
                  .height = 0.5f,
                  .shadow_samples = 4}};
         },
         "marschner"},
        {"far_field",
         [](Settings& s) {
             lit(s);
             s.shading.model = ShadingModel::marschner;
             s.shading.far_field = true;
         },
         "marschner"},
        {"aces",
         [](Settings& s) {
             lit(s);
             s.render.tone_map = ToneMap::aces;
             s.render.exposure = 1.0f;
         },
         "lit"},
        {"agx",
         [](Settings& s) {
             lit(s);
             s.render.tone_map = ToneMap::agx;
             s.render.exposure = 1.0f;
         },
         "aces"},
        {"environment",
         [](Settings& s) {
             lit(s);
             s.render.environment = "assets/studio.exr";
             s.shading.ambient = 1.0f;
         },
         "lit"},
        {"texture", [](Settings& s) { s.strands.texture = "assets/strand_bands.png"; }},
        {"mesh",
         [](Settings& s) {
             lit(s);
             s.render.meshes = {{.file = "assets/head.glb", .translation = {-0.22f, 0.0f, -0.1f}}};
         },
         "lit"},
        {"guides", [](Settings& s) { s.render.overlays.guides = true; }},
        {"root_triangles", [](Settings& s) { s.render.overlays.root_triangles = true; }},
        {"bodies",
         [](Settings& s) {
             s.render.overlays.bodies = true;
             s.simulation.colliders = {
                 {.a = {-0.03f, 0.0f, 0.0f}, .b = {0.03f, 0.02f, 0.0f}, .radius = 0.075f}};
         }},
        {"software",
         [](Settings& s) {
             lit(s);
             s.strands.backend = Backend::software;
             s.strands.curl.radius = 0.004f;
             s.render.msaa = 4;
             s.render.overlays.guides = true;
         },
         "lit"},
        {"tangents", [](Settings& s) { s.render.show = Show::tangents; }},
        {"normals", [](Settings& s) { s.render.show = Show::normals; }, "tangents"},
        {"levels",
         [](Settings& s) {
             s.render.show = Show::lod;
             s.lod = {.mode = LodMode::distance, .near_distance = 0.3f, .far_distance = 0.6f};
         }},
        {"strands", [](Settings& s) { s.render.show = Show::strands; }, "tangents"},
        // The head nods with its mouth open and its brows at rest.
        {"skinned",
         [](Settings& s) {
             s.groom.grow.mesh = "assets/head_talk.glb";
             s.simulation.animation.clip = "talk";
         }},
        {"shadow",
         [](Settings& s) {
             lit(s);
             s.render.show = Show::shadow;
         },
         "lit"},
        {"overdraw", [](Settings& s) { s.render.show = Show::overdraw; }, "tangents"},
        {"density", [](Settings& s) { s.render.show = Show::density; }, "overdraw"},
        // Three heads at different moments of a turn, each with its own shadows.
        {"heads",
         [](Settings& s) {
             lit(s);
             s.shading.lights = {
                 {.type = LightType::directional, .direction = {-2.0f, -3.0f, -1.0f}}};
             s.simulation.motion = {
                 .keyframes =
                     {{.time = 0.0f},
                      {.time = 0.5f, .rotation = {0.0f, 60.0f, 0.0f}},
                      {.time = 1.0f}},
                 .repeat = true};
             s.copies = {.count = 3, .spacing = 0.3f, .motion = CopyMotion::own, .delay = 0.3f};
             s.camera.position = {-0.5f, 0.25f, 0.9f};
             s.camera.target = {0.1f, -0.05f, -0.1f};
         },
         "lit"},
        {"brushed", [](Settings& s) {
             s.groom.edits = {
                 {.tool = BrushTool::comb,
                  .radius = 0.08f,
                  .strength = 0.8f,
                  .path = {{{-0.05f, 0.1f, 0.05f}}, {{0.15f, 0.15f, 0.05f}}}},
                 {.tool = BrushTool::cut,
                  .radius = 0.05f,
                  .strength = 1.0f,
                  .path = {{{-0.2f, -0.05f, -0.1f}}, {{-0.2f, -0.05f, 0.1f}}}}};
         }}};
    return kFeatures;
}

}  // namespace hair
