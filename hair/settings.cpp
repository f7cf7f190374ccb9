#include "hair/settings.h"

#include "hair/field_rows.h"

namespace hair {

// ---- Level of detail ----------------------------------------------------------------------------

const Table& tableOf(const LodSettings*) {
    using S = LodSettings;
    static const Table table = tableWith<S>(
        {choice(
             "mode", &S::mode, {{LodMode::forced, "forced"}, {LodMode::distance, "distance"}},
             "forced: `level` everywhere; distance: by distance from the camera"),
         number("level", &S::level, 0, 8, "1", "forced level; may be fractional"),
         number(
             "near_distance", &S::near_distance, 0.001, 1000, "m",
             "distance up to which level 0 is drawn"),
         number(
             "far_distance", &S::far_distance, 0.001, 1000, "m",
             "distance at which maximum_level is reached"),
         number("maximum_level", &S::maximum_level, 0, 8, "1", "level at far_distance and beyond"),
         choice(
             "merged", &S::merged,
             {{MergedStrands::hairs, "hairs"}, {MergedStrands::strip, "strip"}},
             "how a strand that stands for several is drawn; hairs: all of them, side by side with "
             "gaps; strip: one strand as wide as all of them (thesis)")});
    return table;
}

// ---- Picture ------------------------------------------------------------------------------------

const Table& tableOf(const CameraSettings*) {
    using S = CameraSettings;
    static const Table table = tableWith<S>(
        {number("position", &S::position, -1000, 1000, "m", "position of the camera"),
         number("target", &S::target, -1000, 1000, "m", "point that the camera looks at"),
         number("up", &S::up, -1, 1, "1", "up direction"),
         number("field_of_view", &S::field_of_view, 1, 170, "deg", "vertical field of view"),
         number("near_plane", &S::near_plane, 0.0001, 100, "m", "distance of the near plane"),
         number("far_plane", &S::far_plane, 0.001, 10000, "m", "distance of the far plane")});
    return table;
}

const Table& tableOf(const OverlaySettings*) {
    using S = OverlaySettings;
    static const Table table = tableWith<S>(
        {toggle("guides", &S::guides, "draw the simulated guides over the hair"),
         toggle("root_triangles", &S::root_triangles, "draw the root triangles"),
         toggle("bodies", &S::bodies, "draw the bodies that hair collides with")});
    return table;
}

const Table& tableOf(const MeshSettings*) {
    using S = MeshSettings;
    static const Table table = tableWith<S>(
        {fileName("file", &S::file, "mesh (.gltf, .glb, .obj, ...), relative to the scene"),
         number("translation", &S::translation, -1000, 1000, "m", "position of the mesh's origin"),
         number(
             "rotation", &S::rotation, -360, 360, "deg",
             "rotation about x, then y, then z, before the translation"),
         number("scale", &S::scale, 0.0001, 10000, "1", "scale, before the rotation")});
    return table;
}

const Table& tableOf(const RenderSettings*) {
    using S = RenderSettings;
    static const Table table = tableWith<S>(
        {number("width", &S::width, 1, 8192, "px", "width of the picture"),
         number("height", &S::height, 1, 8192, "px", "height of the picture"),
         oneOf(
             "msaa", &S::msaa, {1, 2, 4, 8}, "samples",
             "multisampling; a case with a count that the device lacks is skipped"),
         oneOf("ssaa", &S::ssaa, {1, 2, 4}, "factor", "supersampling along each side"),
         choice(
             "coverage", &S::coverage,
             {{Coverage::sampled, "sampled"}, {Coverage::analytic, "analytic"}},
             "sampled: a strand covers the samples that lie in it; analytic: a strand thinner than "
             "a pixel is drawn a pixel wide and fainter in proportion, which needs a transparency"),
         choice(
             "transparency", &S::transparency,
             {{Transparency::none, "none"},
              {Transparency::alpha_to_coverage, "alpha_to_coverage"},
              {Transparency::weighted_blended, "weighted_blended"},
              {Transparency::fragment_list, "fragment_list"}},
             "effect of opacity; none: no effect; alpha_to_coverage: a strand covers that fraction "
             "of the samples, which needs msaa; weighted_blended: McGuire and Bavoil 2013; "
             "fragment_list: fragments sorted per pixel"),
         number(
             "list_length", &S::list_length, 1, 256, "count",
             "capacity of fragment_list: mean number of fragments per rendered pixel"),
         choice(
             "tone_map", &S::tone_map,
             {{ToneMap::none, "none"},
              {ToneMap::srgb, "srgb"},
              {ToneMap::aces, "aces"},
              {ToneMap::agx, "agx"}},
             "none: light is added up in display RGB, as in the thesis; the others add up linear "
             "light; srgb: clipped; aces, agx: film-like"),
         number(
             "exposure", &S::exposure, -20, 20, "stops",
             "exposure of linear light, before the tone map"),
         number("background", &S::background, 0, 1, "1", "background colour, display RGB"),
         fileName(
             "environment", &S::environment,
             "environment light and background: latitude-longitude picture (.exr, .hdr), "
             "relative to the scene file; empty: none"),
         number(
             "environment_strength", &S::environment_strength, 0, 1000, "1",
             "factor of the environment's light"),
         number(
             "environment_turn", &S::environment_turn, -360, 360, "deg",
             "rotation of the environment about +y"),
         toggle("head", &S::head, "draw the mesh that the hair grows on"),
         number(
             "scalp_tint", &S::scalp_tint, 0, 1, "1",
             "share of its own colour that the material of /groom/grow/scalp keeps; the rest is "
             "the colour of the material with the most triangles next to it, so that 0 hides its "
             "edge"),
         list("meshes", &S::meshes, 16, "meshes beside the head"),
         toggle("hair", &S::hair, "draw the strands; off: a frame is only simulated"),
         choice(
             "show", &S::show,
             {{Show::shading, "shading"},
              {Show::tangents, "tangents"},
              {Show::normals, "normals"},
              {Show::lod, "lod"},
              {Show::strands, "strands"},
              {Show::groups, "groups"},
              {Show::shadow, "shadow"},
              {Show::overdraw, "overdraw"},
              {Show::density, "density"}},
             "colour of strands. shading: light; tangents, normals: direction along or across them "
             "as RGB; lod: level of detail from blue to red; strands: a colour for each strand; "
             "groups: one for each of the file's groups; "
             "shadow: share of the light that shadows let through; overdraw: number of strand "
             "fragments that a pixel draws; density: number of them in front of the head"),
         group("overlays", &S::overlays, "overlays drawn over the hair")});
    return table;
}

// ---- Run ----------------------------------------------------------------------------------------

const Table& tableOf(const RunSettings*) {
    using S = RunSettings;
    static const Table table = tableWith<S>(
        {number("warmup", &S::warmup, 2, 10000, "count", "frames drawn before measuring"),
         number(
             "frames", &S::frames, 1, 1000000, "count",
             "frames of a round; every round of a mode plays the same frames"),
         number(
             "precision", &S::precision, 0, 1, "1",
             "rounds are played until the half-width of the confidence interval of the median "
             "frame time is this fraction of the median; 0: until max_time"),
         number(
             "max_time", &S::max_time, 0, 86400, "s",
             "time after which no more rounds are begun in a mode; 0: one round"),
         number(
             "case_timeout", &S::case_timeout, 0, 604800, "s",
             "time limit of a case, from its preparation to the end of its measurement; a case "
             "that exceeds it fails, and the next one begins; checked between frames and during "
             "long work of the host; 0: none"),
         number(
             "warmup_time", &S::warmup_time, 0, 60, "s",
             "least time of load before a mode is measured, so that the clock rises; not on a "
             "software device"),
         number(
             "round_time", &S::round_time, 0, 60, "s",
             "least time that a round measures, by playing its frames repeatedly; not on a "
             "software device; 0: once"),
         number(
             "frame_time", &S::frame_time, 0, 1, "s",
             "simulated time that a frame advances; 0 draws the same instant again"),
         number(
             "frames_in_flight", &S::frames_in_flight, 1, 4, "count",
             "overlapped frames that are submitted before the first of them is waited for"),
         toggle(
             "overlapped_stamps", &S::overlapped_stamps,
             "write timestamps in overlapped frames after each pass too, not only at both ends; "
             "passes may then overlap less"),
         toggle(
             "async_compute", &S::async_compute,
             "simulate overlapped frames on a second queue of the device, while the previous frame "
             "is drawn"),
         choice(
             "clocks", &S::clocks,
             {{Clocks::as_found, "as_found"}, {Clocks::locked, "locked"}, {Clocks::free, "free"}},
             "clocks of a GPU while a case is measured. as_found: unchanged; locked: locked by the "
             "program at a rate that the board sustains, if the user may; free: free to change; "
             "such a case is skipped if an administrator has locked them"),
         text(
             "busy_pass", &S::busy_pass,
             "pass to slow down, to see whether a comparison finds it; empty: none"),
         number(
             "busy_work", &S::busy_work, 0, 1000000000, "count",
             "steps of useless work that are added to each busy_pass"),
         fileName(
             "reference", &S::reference,
             "picture (.exr, .png) that the last frame is compared with, relative to the scene "
             "file; empty: none"),
         toggle(
             "compare_backends", &S::compare_backends,
             "also measure figures that compare strand back ends: errors of the picture against "
             "tessellation's and against 64 samples per pixel, times per point and per sample, and "
             "the least time that the device could take")});
    return table;
}

const Table& tableOf(const Settings*) {
    using S = Settings;
    static const Table table = tableWith<S>(
        {text("description", &S::description, "description of the scene, for people"),
         number("seed", &S::seed, 0, 4294967295.0, "1", "seed of every random number"),
         group("groom", &S::groom, "the guides"),
         group("simulation", &S::simulation, "how the guides move"),
         group("strands", &S::strands, "how strands are made from guides"),
         group("lod", &S::lod, "level of detail"),
         group("shading", &S::shading, "how strands are lit"),
         group("camera", &S::camera, "the camera"), group("render", &S::render, "the picture"),
         group("run", &S::run, "how the scene is measured")});
    return table;
}

}  // namespace hair
