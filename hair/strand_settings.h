#pragma once

#include <cstdint>
#include <string>

#include "hair/fields.h"

// How strands are made from guides: settings.h has the other parameters and says how to add one.
namespace hair {

enum class Backend { tessellation, pulling_geometry };
enum class Interpolation { multi, single, mixed };
enum class Randomness { hashed, thesis };
enum class Curve { bspline, bspline_unpinned, catmull_rom };
enum class Taper { strand, segment };
enum class Submission { instanced, batched };
enum class StrandSource { root_triangles, groom };
enum class WidthSource { scene, groom };

// Curls that interpolated strands have beside their guides: thesis 2.3.8.2.
struct StrandCurlSettings {
    float radius = 0.0f;
    float frequency = 60.0f;
    float frequency_variation = 0.2f;
    float start = 0.15f;
};

constexpr auto fields(const StrandCurlSettings*) {
    using S = StrandCurlSettings;
    return std::tuple{
        Field{"radius", &S::radius, 0, 1, "m", "radius of a helix round the smooth strand"},
        Field{
            "frequency", &S::frequency, 0, 10000, "1/m",
            "turns per metre of a strand of mean length"},
        Field{
            "frequency_variation", &S::frequency_variation, 0, 1, "1",
            "largest random change of a strand's frequency, as a fraction"},
        Field{
            "start", &S::start, 0, 1, "1",
            "fraction of the length over which the radius grows from 0"}};
}

// Random offsets, computed once, on a part of the strands: thesis 2.3.8.3.
struct StrandVariationSettings {
    float amplitude = 0.0f;
    float frequency = 20.0f;
    float share = 0.5f;
    float start = 0.1f;
};

constexpr auto fields(const StrandVariationSettings*) {
    using S = StrandVariationSettings;
    return std::tuple{
        Field{"amplitude", &S::amplitude, 0, 1, "m", "largest offset from the smooth strand"},
        Field{"frequency", &S::frequency, 0, 10000, "1/m", "changes of direction per metre"},
        Field{"share", &S::share, 0, 1, "1", "part of the strands that is offset"},
        Field{
            "start", &S::start, 0, 1, "1",
            "fraction of the length over which the offset grows from 0"}};
}

struct StrandSettings {
    Backend backend = Backend::tessellation;
    StrandSource source = StrandSource::root_triangles;
    Interpolation interpolation = Interpolation::multi;
    float blend = 0.5f;
    bool collision_rule = false;
    Randomness randomness = Randomness::hashed;
    std::uint32_t density = 64;
    std::uint32_t tessellation = 4;
    WidthSource width = WidthSource::scene;
    float root_width = 0.002f;
    float tip_width = 0.0005f;
    StrandCurlSettings curl;
    StrandVariationSettings variation;
    std::string offsets;
    float opacity = 1.0f;
    std::string texture;
    Curve curve = Curve::bspline;
    Taper taper = Taper::strand;
    float taper_start = 0.0f;
    Submission submission = Submission::instanced;
};

constexpr auto fields(const StrandSettings*) {
    using S = StrandSettings;
    return std::tuple{
        Choice<S, Backend, 2>{
            "backend",
            &S::backend,
            {{{Backend::tessellation, "tessellation"},
              {Backend::pulling_geometry, "pulling_geometry"}}},
            "tessellation: control, isolines, evaluation, geometry; pulling_geometry: points "
            "evaluated in "
            "the vertex stage, the same geometry stage"},
        Choice<S, StrandSource, 2>{
            "source",
            &S::source,
            {{{StrandSource::root_triangles, "root_triangles"}, {StrandSource::groom, "groom"}}},
            "root_triangles: strands at random places between guides; groom: the strands of the "
            "groom's file, each moved by the three guides that it is bound to"},
        Choice<S, Interpolation, 3>{
            "interpolation",
            &S::interpolation,
            {{{Interpolation::multi, "multi"},
              {Interpolation::single, "single"},
              {Interpolation::mixed, "mixed"}}},
            "multi: the weighted mean of the three guides; single: the guide that weighs most, "
            "moved to the strand's root; mixed: between the two"},
        Field{"blend", &S::blend, 0, 1, "1", "mixed is single at 0 and multi at 1"},
        Toggle<S>{
            "collision_rule", &S::collision_rule,
            "from where one of its guides touches a body down to the tip, a strand is single"},
        Choice<S, Randomness, 2>{
            "randomness",
            &S::randomness,
            {{{Randomness::hashed, "hashed"}, {Randomness::thesis, "thesis"}}},
            "places of strands between guides; hashed: other ones in every root triangle; thesis: "
            "one pattern for all, from a sine"},
        Field{
            "density", &S::density, 1, 4096, "count",
            "strands per root triangle; the source groom has its own"},
        Field{"tessellation", &S::tessellation, 1, 64, "count", "drawn segments per guide segment"},
        Choice<S, WidthSource, 2>{
            "width",
            &S::width,
            {{{WidthSource::scene, "scene"}, {WidthSource::groom, "groom"}}},
            "scene: root_width to tip_width; groom: the widths that the groom has"},
        Field{"root_width", &S::root_width, 0, 0.1, "m", "width at the root"},
        Field{"tip_width", &S::tip_width, 0, 0.1, "m", "width at the tip"},
        Group<S, StrandCurlSettings>{"curl", &S::curl, "curls of the strands between guides"},
        Group<S, StrandVariationSettings>{
            "variation", &S::variation, "disorder of the strands between guides"},
        FileName<S>{
            {"offsets", &S::offsets,
             "strands whose offsets from their own smooth shape are added to drawn ones, relative "
             "to the scene file; empty: none"}},
        Field{
            "opacity", &S::opacity, 0, 1, "1", "of a strand; /render/transparency makes use of it"},
        FileName<S>{
            {"texture", &S::texture,
             "picture (.png, ...) on strands: across them and, downward, from root to tip; its "
             "colour is a factor, its alpha one of the opacity; relative to the scene file; empty: "
             "none"}},
        Choice<S, Curve, 3>{
            "curve",
            &S::curve,
            {{{Curve::bspline, "bspline"},
              {Curve::bspline_unpinned, "bspline_unpinned"},
              {Curve::catmull_rom, "catmull_rom"}}},
            "bspline: uniform cubic B-spline through root and tip; bspline_unpinned: the "
            "thesis's, which floats off the scalp; catmull_rom: through every vertex"},
        Choice<S, Taper, 2>{
            "taper",
            &S::taper,
            {{{Taper::strand, "strand"}, {Taper::segment, "segment"}}},
            "strand: width falls along the whole strand; segment: the published program's, "
            "which restarts in every guide segment"},
        Field{
            "taper_start", &S::taper_start, 0, 1, "1",
            "part of the taper over which the width stays root_width"},
        Choice<S, Submission, 2>{
            "submission",
            &S::submission,
            {{{Submission::instanced, "instanced"}, {Submission::batched, "batched"}}},
            "instanced: a root triangle is an instance; batched: patches in draws that fit the "
            "device"}};
}

}  // namespace hair
