#pragma once

#include <cstdint>
#include <string>

#include <glm/vec3.hpp>

#include "hair/fields.h"

// The parameters of the guides at rest: settings.h has the others and says how to add one.
namespace hair {

// Hair turns round a point of the scalp, as at the crown.
struct WhorlSettings {
    glm::vec3 position{0.0f, 0.11f, -0.06f};
    float strength = 0.0f;
    float radius = 0.05f;
};

constexpr auto fields(const WhorlSettings*) {
    using S = WhorlSettings;
    return std::tuple{
        Field{"position", &S::position, -100, 100, "m", "centre, on or near the scalp"},
        Field{
            "strength", &S::strength, -10, 10, "1",
            "length, at the radius, of the vector round the centre that is added to the direction; "
            "positive is counter-clockwise seen from outside"},
        Field{"radius", &S::radius, 0.001, 10, "m", "distance at which it is strongest"}};
}

// Hair is combed away from a line on the scalp.
struct PartingSettings {
    glm::vec3 from{0.0f, 0.09f, 0.09f};
    glm::vec3 to{0.0f, 0.115f, -0.02f};
    float strength = 0.0f;
    float reach = 0.03f;
};

constexpr auto fields(const PartingSettings*) {
    using S = PartingSettings;
    return std::tuple{
        Field{"from", &S::from, -100, 100, "m", "one end of the line, on or near the scalp"},
        Field{"to", &S::to, -100, 100, "m", "its other end"},
        Field{
            "strength", &S::strength, 0, 10, "1",
            "length, at the line, of the vector away from it that is added to the direction; 0 is "
            "no parting"},
        Field{
            "reach", &S::reach, 0.001, 10, "m",
            "distance from the line over which the vector falls to 1/e"}};
}

enum class RootPlacement { poisson_disc, random };

// Guides grown on the scalp of a mesh.
struct GrowSettings {
    std::string mesh = "assets/head.glb";
    std::string scalp = "scalp";
    std::string mask;
    RootPlacement placement = RootPlacement::poisson_disc;
    std::uint32_t vertices = 8;
    float length = 0.15f;
    std::string length_map;
    float length_variation = 0.0f;
    glm::vec3 comb{0.0f, 0.0f, 0.0f};
    float droop = 0.0f;
    WhorlSettings whorl;
    PartingSettings parting;
};

constexpr auto fields(const GrowSettings*) {
    using S = GrowSettings;
    return std::tuple{
        FileName<S>{{"mesh", &S::mesh, "the mesh; the path is relative to the scene file"}},
        Text<S>{
            "scalp", &S::scalp,
            "where hair grows: the name of a material, part (mesh, object, group) or vertex group "
            "of the mesh; \"*\": everywhere"},
        FileName<S>{
            {"mask", &S::mask,
             "picture over the mesh's texture coordinates: how likely a root is, black never; "
             "empty: everywhere alike"}},
        Choice<S, RootPlacement, 2>{
            "placement",
            &S::placement,
            {{{RootPlacement::poisson_disc, "poisson_disc"}, {RootPlacement::random, "random"}}},
            "poisson_disc: roots keep a distance from each other; random: independent, uniform in "
            "area"},
        Field{"vertices", &S::vertices, 2, 256, "count", "vertices per guide, root included"},
        Field{"length", &S::length, 0.001, 2, "m", "length of a guide"},
        FileName<S>{
            {"length_map", &S::length_map,
             "picture over the mesh's texture coordinates whose brightness, 0 to 1, is a factor of "
             "the length; empty: 1"}},
        Field{
            "length_variation", &S::length_variation, 0, 0.99, "1",
            "a guide is shorter by a random fraction up to this"},
        Field{
            "comb", &S::comb, -10, 10, "1",
            "vector added to the unit surface normal before a guide's direction is normalised"},
        Field{
            "droop", &S::droop, 0, 100, "1/m",
            "how fast the direction turns toward gravity along the guide; 0 is straight"},
        Group<S, WhorlSettings>{"whorl", &S::whorl, "hair turning round a point"},
        Group<S, PartingSettings>{"parting", &S::parting, "hair combed away from a line"}};
}

// ---- Styling, in the order in which it is applied -----------------------------------------------

struct ClumpSettings {
    float strength = 0.0f;
    float spacing = 0.02f;
    float start = 0.1f;
};

constexpr auto fields(const ClumpSettings*) {
    using S = ClumpSettings;
    return std::tuple{
        Field{
            "strength", &S::strength, 0, 1, "1",
            "how far a tip is drawn to its clump's centre strand; 1 is all the way"},
        Field{"spacing", &S::spacing, 0.0001, 10, "m", "distance between the roots of two clumps"},
        Field{"start", &S::start, 0, 1, "1", "fraction of the length up to which nothing moves"}};
}

struct WaveSettings {
    float amplitude = 0.0f;
    float frequency = 20.0f;
    float phase_variation = 0.0f;
    float start = 0.2f;
};

constexpr auto fields(const WaveSettings*) {
    using S = WaveSettings;
    return std::tuple{
        Field{"amplitude", &S::amplitude, 0, 1, "m", "amplitude of a plane sine across the strand"},
        Field{"frequency", &S::frequency, 0, 10000, "1/m", "waves per metre of strand"},
        Field{
            "phase_variation", &S::phase_variation, 0, 1, "1",
            "random phase of a strand, up to this part of a wave"},
        Field{
            "start", &S::start, 0, 1, "1",
            "fraction of the length over which the amplitude grows from 0"}};
}

struct CurlSettings {
    float radius = 0.0f;
    float frequency = 40.0f;
    float phase_variation = 0.0f;
    float start = 0.2f;
};

constexpr auto fields(const CurlSettings*) {
    using S = CurlSettings;
    return std::tuple{
        Field{"radius", &S::radius, 0, 1, "m", "radius of a helix round the strand"},
        Field{"frequency", &S::frequency, 0, 10000, "1/m", "turns per metre of strand"},
        Field{
            "phase_variation", &S::phase_variation, 0, 1, "1",
            "random phase of a strand, up to this part of a turn"},
        Field{
            "start", &S::start, 0, 1, "1",
            "fraction of the length over which the radius grows from 0"}};
}

struct FrizzSettings {
    float amplitude = 0.0f;
    float frequency = 60.0f;
    float start = 0.1f;
};

constexpr auto fields(const FrizzSettings*) {
    using S = FrizzSettings;
    return std::tuple{
        Field{
            "amplitude", &S::amplitude, 0, 1, "m",
            "largest random displacement, different for every strand"},
        Field{"frequency", &S::frequency, 0, 10000, "1/m", "changes of direction per metre"},
        Field{
            "start", &S::start, 0, 1, "1",
            "fraction of the length over which the amplitude grows from 0"}};
}

struct CutSettings {
    float length = 0.0f;
    glm::vec3 point{0.0f, 0.0f, 0.0f};
    glm::vec3 normal{0.0f, 0.0f, 0.0f};
};

constexpr auto fields(const CutSettings*) {
    using S = CutSettings;
    return std::tuple{
        Field{"length", &S::length, 0, 10, "m", "longer strands are cut to this; 0 cuts none"},
        Field{"point", &S::point, -100, 100, "m", "a point of a plane"},
        Field{
            "normal", &S::normal, -1, 1, "1",
            "direction in which nothing is left beyond the plane; without length there is no "
            "plane"}};
}

struct TaperSettings {
    float root_width = 0.0f;
    float tip_width = 0.0f;
    float start = 0.0f;
};

constexpr auto fields(const TaperSettings*) {
    using S = TaperSettings;
    return std::tuple{
        Field{
            "root_width", &S::root_width, 0, 0.1, "m",
            "width that the groom gets, up to the start; 0 leaves its widths as they are"},
        Field{"tip_width", &S::tip_width, 0, 0.1, "m", "width at the tip"},
        Field{"start", &S::start, 0, 1, "1", "fraction of the length at which the width falls"}};
}

struct StyleSettings {
    ClumpSettings clump;
    WaveSettings wave;
    CurlSettings curl;
    FrizzSettings frizz;
    CutSettings cut;
    TaperSettings taper;
};

constexpr auto fields(const StyleSettings*) {
    using S = StyleSettings;
    return std::tuple{
        Group<S, ClumpSettings>{"clump", &S::clump, "strands drawn together"},
        Group<S, WaveSettings>{"wave", &S::wave, "waves in a plane"},
        Group<S, CurlSettings>{"curl", &S::curl, "helices"},
        Group<S, FrizzSettings>{"frizz", &S::frizz, "disorder"},
        Group<S, CutSettings>{"cut", &S::cut, "scissors"},
        Group<S, TaperSettings>{"taper", &S::taper, "widths"}};
}

// ---- Where guides come from ---------------------------------------------------------------------

// Takes a file's coordinates to the scene's: scaled, then turned about x, y and z in this order,
// then moved.
struct FilePlacementSettings {
    float scale = 1.0f;
    glm::vec3 rotation{0.0f, 0.0f, 0.0f};
    glm::vec3 translation{0.0f, 0.0f, 0.0f};
};

constexpr auto fields(const FilePlacementSettings*) {
    using S = FilePlacementSettings;
    return std::tuple{
        Field{
            "scale", &S::scale, 1e-6, 1e6, "1",
            "metres in the file's unit of length; formats that state their unit are already in "
            "metres"},
        Field{"rotation", &S::rotation, -360, 360, "deg", "about x, then y, then z"},
        Field{"translation", &S::translation, -1000, 1000, "m", "after scale and rotation"}};
}

struct GroomSettings {
    std::string file;
    std::string mesh;
    FilePlacementSettings placement;
    std::uint32_t vertices = 0;
    std::uint32_t guides = 0;
    GrowSettings grow;
    StyleSettings style;
};

constexpr auto fields(const GroomSettings*) {
    using S = GroomSettings;
    return std::tuple{
        FileName<S>{
            {"file", &S::file,
             "strands (.hair, .tfx, .hgl, .ply, .obj, .gltf, .glb, .usd), relative to the scene "
             "file; empty: guides are grown"}},
        FileName<S>{
            {"mesh", &S::mesh,
             "what the strands of the file grow on; empty: nothing, they float. Grown guides have "
             "/groom/grow/mesh"}},
        Group<S, FilePlacementSettings>{
            "placement", &S::placement, "where the strands of the file go"},
        Field{
            "vertices", &S::vertices, 0, 256, "count",
            "vertices per strand that the file is resampled to, 0 or at least 2; 0: as many as its "
            "longest list has"},
        Field{
            "guides", &S::guides, 0, 200000, "count",
            "guides to grow, or to choose from the file; 0: all of the file's strands, or 86 grown "
            "ones"},
        Group<S, GrowSettings>{"grow", &S::grow, "guides grown on a scalp"},
        Group<S, StyleSettings>{"style", &S::style, "what is done to the guides then"}};
}

}  // namespace hair
