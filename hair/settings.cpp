#include "hair/settings.h"

#include <algorithm>
#include <cassert>

#include "hair/field_rows.h"

namespace hair {

// ---- Strands ------------------------------------------------------------------------------------

namespace {

constexpr std::initializer_list<Named<Backend>> kBackendNames{
    {Backend::automatic, "automatic"},
    {Backend::tessellation, "tessellation"},
    {Backend::pulling_geometry, "pulling_geometry"},
    {Backend::lines, "lines"},
    {Backend::pulling, "pulling"},
    {Backend::expanded, "expanded"},
    {Backend::mesh, "mesh"},
    {Backend::software, "software"},
    {Backend::rays, "rays"}};

}  // namespace

const char* backendName(Backend backend) {
    const auto named = std::ranges::find(kBackendNames, backend, &Named<Backend>::value);
    assert(named != kBackendNames.end());
    return named->name;
}

const Table& tableOf(const RaysSettings*) {
    using S = RaysSettings;
    static const Table table = tableWith<S>(
        {choice(
             "geometry", &S::geometry,
             {{RaysGeometry::triangles, "triangles"}, {RaysGeometry::boxes, "boxes"}},
             "pieces of strands as rays meet them; triangles: of the quads that the other back "
             "ends draw; boxes: round, each in a box of its own, intersected by the shader"),
         choice(
             "update", &S::update, {{RaysUpdate::build, "build"}, {RaysUpdate::refit, "refit"}},
             "acceleration structure of the back end rays in each frame; build: built anew; refit: "
             "built once, and fitted to the strands as they move")});
    return table;
}

const Table& tableOf(const StrandCurlSettings*) {
    using S = StrandCurlSettings;
    static const Table table = tableWith<S>(
        {number("radius", &S::radius, 0, 1, "m", "radius of a helix round the smooth strand"),
         number(
             "frequency", &S::frequency, 0, 10000, "1/m",
             "turns per metre of a strand of mean length"),
         number(
             "frequency_variation", &S::frequency_variation, 0, 1, "1",
             "largest random change of a strand's frequency, as a fraction"),
         number(
             "start", &S::start, 0, 1, "1",
             "fraction of the length over which the radius grows from 0")});
    return table;
}

const Table& tableOf(const StrandVariationSettings*) {
    using S = StrandVariationSettings;
    static const Table table = tableWith<S>(
        {number("amplitude", &S::amplitude, 0, 1, "m", "largest offset from the smooth strand"),
         number("frequency", &S::frequency, 0, 10000, "1/m", "changes of direction per metre"),
         number("share", &S::share, 0, 1, "1", "fraction of the strands that is offset"),
         number(
             "start", &S::start, 0, 1, "1",
             "fraction of the length over which the offset grows from 0")});
    return table;
}

const Table& tableOf(const StrandSettings*) {
    using S = StrandSettings;
    static const Table table = tableWith<S>(
        {choice(
             "backend", &S::backend, kBackendNames,
             "automatic: the fastest that can draw the case on the device; tessellation: control, "
             "isolines, evaluation, geometry; pulling_geometry: points "
             "evaluated in the vertex stage, the same geometry stage; lines: lines a pixel wide "
             "instead of quads; pulling: corners of quads made in the vertex stage; expanded: "
             "likewise, from points evaluated in compute; "
             "mesh: task stages choose blocks of strands, mesh stages make their quads; "
             "software: rasterised in compute; rays: found by a ray query for each sample"),
         choice(
             "source", &S::source,
             {{StrandSource::root_triangles, "root_triangles"}, {StrandSource::groom, "groom"}},
             "root_triangles: strands at random places between guides; groom: the strands of the "
             "groom's file, each moved by the three guides that it is bound to"),
         choice(
             "interpolation", &S::interpolation,
             {{Interpolation::multi, "multi"},
              {Interpolation::single, "single"},
              {Interpolation::mixed, "mixed"}},
             "multi: the weighted mean of the three guides; single: the guide that weighs most, "
             "moved to the strand's root; mixed: between the two"),
         number(
             "blend", &S::blend, 0, 1, "1",
             "weight of multi in mixed interpolation: 0 is single, 1 is multi"),
         toggle(
             "collision_rule", &S::collision_rule,
             "a strand is interpolated as single from where one of its guides touches a body to "
             "the tip"),
         choice(
             "collision", &S::collision,
             {{StrandCollision::none, "none"}, {StrandCollision::push_out, "push_out"}},
             "collision of drawn strands with bodies; none: only guides collide; push_out: points "
             "inside a body, or within the margin of its surface, are moved out"),
         choice(
             "randomness", &S::randomness,
             {{Randomness::hashed, "hashed"}, {Randomness::thesis, "thesis"}},
             "places of strands between guides; hashed: different places in every root triangle; "
             "thesis: one pattern for all triangles, from a sine"),
         number(
             "density", &S::density, 1, 4096, "count",
             "strands per root triangle; not used if source is groom, which has its own strands"),
         number(
             "tessellation", &S::tessellation, 1, 64, "count", "drawn segments per guide segment"),
         choice(
             "width", &S::width, {{WidthSource::scene, "scene"}, {WidthSource::groom, "groom"}},
             "scene: root_width to tip_width; groom: the widths that the groom has"),
         number("root_width", &S::root_width, 0, 0.1, "m", "width at the root"),
         number("tip_width", &S::tip_width, 0, 0.1, "m", "width at the tip"),
         group("curl", &S::curl, "curls of the strands between guides"),
         group("variation", &S::variation, "disorder of the strands between guides"),
         fileName(
             "offsets", &S::offsets,
             "strands whose offsets from their own smooth shape are added to drawn ones, relative "
             "to the scene file; empty: none"),
         extensionFile(
             "offset_function", &S::offset_function,
             "file of GLSL (.glsl) that offsets drawn strands, relative to the scene file: "
             "docs/extending.md; empty: none"),
         parameters(
             "offset_parameters", &S::offset_parameters,
             "parameters of the file that offset_function names, with the names, ranges and units "
             "that it declares"),
         number(
             "opacity", &S::opacity, 0, 1, "1",
             "opacity of a strand, as used by /render/transparency"),
         fileName(
             "texture", &S::texture,
             "picture (.png, ...) on strands: across them and, downward, from root to tip; its "
             "colour multiplies that of the strand, its alpha the opacity; relative to the scene "
             "file; empty: "
             "none"),
         choiceOrFile(
             "curve", &S::curve,
             {{Curve::bspline, "bspline"},
              {Curve::bspline_unpinned, "bspline_unpinned"},
              {Curve::catmull_rom, "catmull_rom"}},
             Curve::extension, &S::curve_file,
             "bspline: uniform cubic B-spline through root and tip; bspline_unpinned: the "
             "thesis's, which floats off the scalp; catmull_rom: through every vertex; a file of "
             "GLSL (.glsl), relative to the scene file: docs/extending.md"),
         parameters(
             "curve_parameters", &S::curve_parameters,
             "parameters of the file that curve names, with the names, ranges and units that it "
             "declares"),
         choice(
             "taper", &S::taper, {{Taper::strand, "strand"}, {Taper::segment, "segment"}},
             "strand: width falls along the whole strand; segment: width falls anew in every guide "
             "segment, as in the published program"),
         number(
             "taper_start", &S::taper_start, 0, 1, "1",
             "part of the taper over which the width stays root_width"),
         choice(
             "submission", &S::submission,
             {{Submission::instanced, "instanced"}, {Submission::batched, "batched"}},
             "instanced: a root triangle is an instance; batched: patches are divided into draws "
             "that fit the device"),
         group("rays", &S::rays, "the back end rays")});
    return table;
}

// ---- Level of detail ----------------------------------------------------------------------------

const Table& tableOf(const LodSettings*) {
    using S = LodSettings;
    static const Table table = tableWith<S>(
        {choice(
             "mode", &S::mode,
             {{LodMode::forced, "forced"},
              {LodMode::distance, "distance"},
              {LodMode::cluster, "cluster"}},
             "forced: `level` everywhere; distance: by distance from the camera; cluster: each "
             "cluster of strands as coarse as `error` lets it be"),
         number("level", &S::level, 0, 8, "1", "forced level; may be fractional"),
         number(
             "near_distance", &S::near_distance, 0.001, 1000, "m",
             "distance up to which level 0 is drawn"),
         number(
             "far_distance", &S::far_distance, 0.001, 1000, "m",
             "distance at which maximum_level is reached"),
         number("maximum_level", &S::maximum_level, 0, 8, "1", "level at far_distance and beyond"),
         number(
             "error", &S::error, 0.01, 1000, "px",
             "with `cluster`: greatest distance in the picture between the strands that are drawn "
             "and those of level 0"),
         choice(
             "merged", &S::merged,
             {{MergedStrands::hairs, "hairs"}, {MergedStrands::strip, "strip"}},
             "how a strand that stands for several is drawn; hairs: all of them, side by side with "
             "gaps; strip: one strand as wide as all of them (thesis)")});
    return table;
}

// ---- Copies -------------------------------------------------------------------------------------

const Table& tableOf(const CopySettings*) {
    using S = CopySettings;
    static const Table table = tableWith<S>(
        {number("count", &S::count, 1, 128, "count", "heads with the same hair, in a square grid"),
         number("spacing", &S::spacing, 0, 100, "m", "distance between neighbouring heads"),
         choice(
             "motion", &S::motion, {{CopyMotion::shared, "shared"}, {CopyMotion::own, "own"}},
             "shared: one simulation moves the hair of all heads; own: each head has a simulation, "
             "with its own seed of the wind and a motion that `delay` shifts"),
         number(
             "delay", &S::delay, 0, 1000, "s",
             "with motion own: each head is this much further in /simulation/motion than the one "
             "before")});
    return table;
}

std::vector<glm::vec3> copyOffsets(const CopySettings& settings) {
    std::uint32_t columns = 1;
    while (columns * columns < settings.count) ++columns;
    std::vector<glm::vec3> offsets;
    for (std::uint32_t i = 0; i < settings.count; ++i) {
        const std::uint32_t column = i % columns;
        const float steps = static_cast<float>((column + 1) / 2);
        const float right = column % 2 == 1 ? steps : -steps;
        offsets.push_back(
            settings.spacing * glm::vec3(right, 0.0f, -static_cast<float>(i / columns)));
    }
    return offsets;
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

const Table& tableOf(const ProbeSettings*) {
    using S = ProbeSettings;
    static const Table table = tableWith<S>(
        {toggle(
             "tip_displacement", &S::tip_displacement,
             "distance of tips from where the head would carry them rigidly"),
         toggle(
             "groom_distance", &S::groom_distance,
             "distance of all vertices from where the head would carry them rigidly from the groom "
             "or from `reference`"),
         toggle("length_error", &S::length_error, "strain of segments, without its sign"),
         toggle(
             "energy", &S::energy,
             "kinetic and gravitational energy, and with `rod` elastic energy"),
         toggle(
             "contact", &S::contact,
             "vertices that touch bodies, and the greatest depth of a vertex in a body"),
         toggle("speed", &S::speed, "greatest speed of a vertex"),
         toggle("bending", &S::bending, "angle between successive segments"),
         toggle("torsion", &S::torsion, "angle between successive planes of two segments"),
         toggle("momentum", &S::momentum, "momentum along x, y and z"),
         fileName(
             "reference", &S::reference,
             "strands to which groom_distance measures instead of to the groom, one for each guide "
             "with as many points, relative to the scene file; empty: the groom"),
         number("first_guide", &S::first_guide, 0, 4294967295.0, "1", "first guide that counts"),
         number(
             "guides", &S::guides, 0, 4294967295.0, "count",
             "guides that count, from first_guide on; 0: all of them")});
    return table;
}

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
         toggle(
             "interpolate", &S::interpolate,
             "draw guides, roots and the head between the last two steps, at the frame's time less "
             "one /simulation/time_step, so that motion is even if steps do not divide frames"),
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
             "the least time that the device could take"),
         group(
             "probes", &S::probes,
             "quantities of guides in every frame, measured in a round of their own")});
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
         group("lod", &S::lod, "level of detail"), group("copies", &S::copies, "several heads"),
         group("shading", &S::shading, "how strands are lit"),
         group("camera", &S::camera, "the camera"), group("render", &S::render, "the picture"),
         group("run", &S::run, "how the scene is measured")});
    return table;
}

}  // namespace hair
