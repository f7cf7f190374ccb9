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
             "what a strand that stands for several is drawn as: hairs: these, side by side with "
             "gaps; strip: one as wide as all of them (thesis)")});
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
         number("translation", &S::translation, -1000, 1000, "m", "where the mesh's origin is"),
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
             "multisampling; a count the device lacks is skipped"),
         oneOf("ssaa", &S::ssaa, {1, 2, 4}, "factor", "supersampling along each side"),
         choice(
             "coverage", &S::coverage,
             {{Coverage::sampled, "sampled"}, {Coverage::analytic, "analytic"}},
             "sampled: a strand is where samples hit it; analytic: a strand thinner than a pixel "
             "is as wide as one and as much fainter, which needs a transparency"),
         choice(
             "transparency", &S::transparency,
             {{Transparency::none, "none"},
              {Transparency::alpha_to_coverage, "alpha_to_coverage"},
              {Transparency::weighted_blended, "weighted_blended"},
              {Transparency::fragment_list, "fragment_list"}},
             "what opacity does; none: nothing; alpha_to_coverage: covers a fraction of the "
             "samples, which needs msaa; weighted_blended: McGuire and Bavoil 2013; fragment_list: "
             "fragments sorted per pixel"),
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
             "light from all around and background: latitude-longitude picture (.exr, .hdr), "
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
             "how much of its own colour the material that /groom/grow/scalp names has; the rest "
             "is "
             "that of the material with the most triangles beside it, so that at 0 no edge of it "
             "shows"),
         list("meshes", &S::meshes, 16, "meshes beside the head"),
         toggle("hair", &S::hair, "draw the strands; without them a frame is its simulation"),
         choice(
             "show", &S::show,
             {{Show::shading, "shading"},
              {Show::tangents, "tangents"},
              {Show::normals, "normals"},
              {Show::lod, "lod"},
              {Show::strands, "strands"},
              {Show::shadow, "shadow"},
              {Show::overdraw, "overdraw"},
              {Show::density, "density"}},
             "what colours strands: light; directions along and across them as RGB; the level of "
             "detail from blue to red; a colour of each strand's own; the part of the lights that "
             "shadows let through; how many fragments of strands a pixel draws; or how many there "
             "are in front of the head"),
         group("overlays", &S::overlays, "what is drawn over the hair")});
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
             "time after which a case has failed that is not made and measured, and the next one "
             "begins: heeded between frames and in what takes long without the device; 0: none"),
         number(
             "warmup_time", &S::warmup_time, 0, 60, "s",
             "load before a mode is measured on a device that is no processor, at least: its clock "
             "rises"),
         number(
             "round_time", &S::round_time, 0, 60, "s",
             "time that a round measures at least on a device that is no processor, by playing its "
             "frames again and again; 0: once"),
         number(
             "frame_time", &S::frame_time, 0, 1, "s",
             "simulated time that a frame advances; 0 draws the same instant again"),
         number(
             "frames_in_flight", &S::frames_in_flight, 1, 4, "count",
             "overlapped frames that the device is given before the first of them is waited for"),
         toggle(
             "overlapped_stamps", &S::overlapped_stamps,
             "stamp overlapped frames after each pass too, not at both ends alone: passes may then "
             "overlap less"),
         toggle(
             "async_compute", &S::async_compute,
             "simulate overlapped frames on a second queue of the device, beside the drawing of "
             "the "
             "frame before"),
         choice(
             "clocks", &S::clocks,
             {{Clocks::as_found, "as_found"}, {Clocks::locked, "locked"}, {Clocks::free, "free"}},
             "clocks of a GPU while a case is measured: as they are; locked by the program at what "
             "the board sustains, where the user may; or free to change, a case of which is "
             "skipped "
             "where an administrator holds them"),
         text(
             "busy_pass", &S::busy_pass,
             "pass to slow down, to see whether a comparison finds it; empty: none"),
         number(
             "busy_work", &S::busy_work, 0, 1000000000, "count",
             "steps of work that nobody needs, added to each busy_pass"),
         fileName(
             "reference", &S::reference,
             "picture (.exr, .png) that the last frame is compared with, relative to the scene "
             "file; empty: none"),
         toggle(
             "compare_backends", &S::compare_backends,
             "what it takes to compare strand back ends: errors of the picture against "
             "tessellation's and against 64 samples a pixel, times per point and per sample, and "
             "the least time that the device could take")});
    return table;
}

const Table& tableOf(const Settings*) {
    using S = Settings;
    static const Table table = tableWith<S>(
        {text("description", &S::description, "what the scene shows, for people"),
         number("seed", &S::seed, 0, 4294967295.0, "1", "seed of every random number"),
         group("groom", &S::groom, "the guides"),
         group("simulation", &S::simulation, "how the guides move"),
         group("strands", &S::strands, "how strands are made from guides"),
         group("lod", &S::lod, "level of detail"),
         group("shading", &S::shading, "how strands are lit"),
         group("camera", &S::camera, "the camera"), group("render", &S::render, "the picture"),
         group("run", &S::run, "what is measured")});
    return table;
}

}  // namespace hair
