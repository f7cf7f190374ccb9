#include "hair/strand_settings.h"

#include <algorithm>
#include <cassert>

#include "hair/field_rows.h"

namespace hair {
namespace {

constexpr std::initializer_list<Named<Backend>> kBackendNames{
    {Backend::automatic, "automatic"},
    {Backend::tessellation, "tessellation"},
    {Backend::pulling_geometry, "pulling_geometry"},
    {Backend::lines, "lines"},
    {Backend::pulling, "pulling"},
    {Backend::expanded, "expanded"},
    {Backend::mesh, "mesh"},
    {Backend::software, "software"}};

}  // namespace

const char* backendName(Backend backend) {
    const auto named = std::ranges::find(kBackendNames, backend, &Named<Backend>::value);
    assert(named != kBackendNames.end());
    return named->name;
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
             "software: rasterised in compute"),
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
         choice(
             "curve", &S::curve,
             {{Curve::bspline, "bspline"},
              {Curve::bspline_unpinned, "bspline_unpinned"},
              {Curve::catmull_rom, "catmull_rom"}},
             "bspline: uniform cubic B-spline through root and tip; bspline_unpinned: the "
             "thesis's, which floats off the scalp; catmull_rom: through every vertex"),
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
             "that fit the device")});
    return table;
}

}  // namespace hair
