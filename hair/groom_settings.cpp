#include "hair/groom_settings.h"

#include "hair/field_rows.h"

namespace hair {

const Table& tableOf(const WhorlSettings*) {
    using S = WhorlSettings;
    static const Table table = tableWith<S>(
        {number("position", &S::position, -100, 100, "m", "centre, on or near the scalp"),
         number(
             "strength", &S::strength, -10, 10, "1",
             "length, at the radius, of the vector round the centre that is added to the "
             "direction; positive is counter-clockwise seen from outside"),
         number(
             "radius", &S::radius, 0.001, 10, "m",
             "distance from the centre at which the whorl is strongest")});
    return table;
}

const Table& tableOf(const PartingSettings*) {
    using S = PartingSettings;
    static const Table table = tableWith<S>(
        {number("from", &S::from, -100, 100, "m", "one end of the line, on or near the scalp"),
         number("to", &S::to, -100, 100, "m", "the other end of the line, on or near the scalp"),
         number(
             "strength", &S::strength, 0, 10, "1",
             "length, at the line, of the vector away from it that is added to the direction; 0 is "
             "no parting"),
         number(
             "reach", &S::reach, 0.001, 10, "m",
             "distance from the line over which the vector falls to 1/e")});
    return table;
}

const Table& tableOf(const VellusSettings*) {
    using S = VellusSettings;
    static const Table table = tableWith<S>(
        {number(
             "share", &S::share, 0, 10, "1",
             "vellus hairs, as a fraction of /groom/grow/strands; they only follow the head, and "
             "are drawn if /strands/source is groom; 0: none"),
         number(
             "length", &S::length, 0.001, 0.1, "m",
             "greatest length at the edge of the scalp; twice that a band further in"),
         number("width", &S::width, 1e-6, 0.001, "m", "width at the root"),
         number(
             "band", &S::band, 0.001, 0.1, "m",
             "distance from the edge of the scalp, on either side, over which they thin out")});
    return table;
}

const Table& tableOf(const GrowSettings*) {
    using S = GrowSettings;
    static const Table table = tableWith<S>(
        {fileName("mesh", &S::mesh, "mesh that hair grows on, relative to the scene file"),
         text(
             "scalp", &S::scalp,
             "where hair grows: the name of a material, part (mesh, object, group) or vertex group "
             "of the mesh; \"*\": everywhere"),
         fileName(
             "mask", &S::mask,
             "picture over the mesh's texture coordinates: relative density of roots, none where "
             "it is black; empty: the same everywhere"),
         choice(
             "placement", &S::placement,
             {{RootPlacement::poisson_disc, "poisson_disc"}, {RootPlacement::random, "random"}},
             "poisson_disc: roots keep a distance from each other; random: independent, uniform in "
             "area"),
         number(
             "strands", &S::strands, 0, 1000000, "count",
             "strands to grow and style; /groom/guides of them become guides, as with a file; "
             "/strands/source groom draws all of them; 0: only guides are grown"),
         number("vertices", &S::vertices, 2, 256, "count", "vertices per guide, root included"),
         number("length", &S::length, 0.001, 2, "m", "length of a guide"),
         fileName(
             "length_map", &S::length_map,
             "picture over the mesh's texture coordinates whose brightness, 0 to 1, is a factor of "
             "the length; empty: 1"),
         number(
             "length_variation", &S::length_variation, 0, 0.99, "1",
             "a guide is shorter by a random fraction up to this"),
         number(
             "comb", &S::comb, -10, 10, "1",
             "vector added to the unit surface normal before a guide's direction is normalised"),
         number(
             "droop", &S::droop, 0, 100, "1/m",
             "how fast the direction turns toward gravity along the guide; 0 is straight"),
         group("whorl", &S::whorl, "hair turning round a point"),
         group("parting", &S::parting, "hair combed away from a line"),
         group("vellus", &S::vellus, "short, thin hairs along the edge of the scalp")});
    return table;
}

// ---- Styling, in the order of application -------------------------------------------------------

const Table& tableOf(const BraidSettings*) {
    using S = BraidSettings;
    static const Table table = tableWith<S>(
        {number(
             "pitch", &S::pitch, 0, 1, "m",
             "length of braid over which its three parts return to their places; 0: no braid"),
         number("tie", &S::tie, -100, 100, "m", "point where all strands are gathered"),
         number("direction", &S::direction, -1, 1, "1", "direction of the braid from the tie"),
         number("width", &S::width, 0.001, 1, "m", "width of the braid at the tie"),
         number(
             "length", &S::length, 0, 10, "m",
             "length of the braid, after which strands hang loose; 0: to their tips")});
    return table;
}

const Table& tableOf(const ClumpSettings*) {
    using S = ClumpSettings;
    static const Table table = tableWith<S>(
        {number(
             "strength", &S::strength, 0, 1, "1",
             "how far a tip is drawn to its clump's centre strand; 1 is all the way"),
         number(
             "variation", &S::variation, 0, 1, "1",
             "a strand's strength is smaller by a random fraction up to this"),
         number(
             "spacing", &S::spacing, 0.0001, 10, "m", "distance between the roots of two clumps"),
         number(
             "levels", &S::levels, 1, 6, "count",
             "levels of clumps within clumps: the clumps of each level are half as far apart as "
             "those of the level before, and are drawn together first"),
         number(
             "start", &S::start, 0, 1, "1", "fraction of the length up to which nothing moves")});
    return table;
}

const Table& tableOf(const WaveSettings*) {
    using S = WaveSettings;
    static const Table table = tableWith<S>(
        {number(
             "amplitude", &S::amplitude, 0, 1, "m", "amplitude of a plane sine across the strand"),
         number("frequency", &S::frequency, 0, 10000, "1/m", "waves per metre of strand"),
         number(
             "phase_variation", &S::phase_variation, 0, 1, "1",
             "random phase of a strand, up to this part of a wave"),
         number(
             "spacing", &S::spacing, 0, 10, "m",
             "distance between roots that set the phase; each strand has the phase of the nearest "
             "one; 0: each strand has its own"),
         number(
             "drift", &S::drift, 0, 10, "1",
             "largest drift of the phase to either side along a strand, in waves"),
         number(
             "start", &S::start, 0, 1, "1",
             "fraction of the length over which the amplitude grows from 0")});
    return table;
}

const Table& tableOf(const CurlSettings*) {
    using S = CurlSettings;
    static const Table table = tableWith<S>(
        {number("radius", &S::radius, 0, 1, "m", "radius of a helix round the strand"),
         number("frequency", &S::frequency, 0, 10000, "1/m", "turns per metre of strand"),
         number(
             "phase_variation", &S::phase_variation, 0, 1, "1",
             "random phase of a strand, up to this part of a turn"),
         number(
             "spacing", &S::spacing, 0, 10, "m",
             "distance between roots that set the phase; each strand has the phase of the nearest "
             "one; 0: each strand has its own"),
         number(
             "drift", &S::drift, 0, 10, "1",
             "largest drift of the phase to either side along a strand, in turns"),
         number(
             "start", &S::start, 0, 1, "1",
             "fraction of the length over which the radius grows from 0")});
    return table;
}

const Table& tableOf(const FrizzSettings*) {
    using S = FrizzSettings;
    static const Table table = tableWith<S>(
        {number(
             "amplitude", &S::amplitude, 0, 1, "m",
             "largest random displacement, different for every strand"),
         number("frequency", &S::frequency, 0, 10000, "1/m", "changes of direction per metre"),
         number(
             "start", &S::start, 0, 1, "1",
             "fraction of the length over which the amplitude grows from 0")});
    return table;
}

const Table& tableOf(const FlyawaySettings*) {
    using S = FlyawaySettings;
    static const Table table = tableWith<S>(
        {number("share", &S::share, 0, 1, "1", "fraction of the strands that are flyaways"),
         number(
             "reach", &S::reach, 0, 1, "m",
             "largest displacement of their tips; each follows a smooth path of its own"),
         number(
             "start", &S::start, 0, 1, "1", "fraction of the length up to which nothing moves")});
    return table;
}

const Table& tableOf(const CutSettings*) {
    using S = CutSettings;
    static const Table table = tableWith<S>(
        {number(
             "length", &S::length, 0, 10, "m",
             "length that longer strands are cut to; 0 cuts none"),
         number("point", &S::point, -100, 100, "m", "point on the cutting plane"),
         number(
             "normal", &S::normal, -1, 1, "1",
             "normal of the cutting plane: hair on the side that it points to is cut off; zero: no "
             "plane"),
         number(
             "variation", &S::variation, 0, 1, "m",
             "a strand that is cut is shorter by a random length up to this")});
    return table;
}

const Table& tableOf(const TaperSettings*) {
    using S = TaperSettings;
    static const Table table = tableWith<S>(
        {number(
             "root_width", &S::root_width, 0, 0.1, "m",
             "width at the root and up to start; 0 leaves the groom's widths as they are"),
         number("tip_width", &S::tip_width, 0, 0.1, "m", "width at the tip"),
         number(
             "start", &S::start, 0, 1, "1", "fraction of the length from which the width falls")});
    return table;
}

const Table& tableOf(const StyleSettings*) {
    using S = StyleSettings;
    static const Table table = tableWith<S>(
        {group("braid", &S::braid, "all strands in one braid"),
         group("clump", &S::clump, "clumps of strands drawn together at their tips"),
         group("wave", &S::wave, "plane waves along strands"),
         group("curl", &S::curl, "strands wound into helices"),
         group("frizz", &S::frizz, "random displacement of strands"),
         group("flyaways", &S::flyaways, "flyaways: strands apart from the rest"),
         number(
             "clearance", &S::clearance, 0, 0.1, "m",
             "distance from the mesh that hair grows on; strands that would come nearer are turned "
             "away; 0: strands may pass through the mesh"),
         group("cut", &S::cut, "strands cut to a length or at a plane"),
         group("taper", &S::taper, "width of strands from root to tip")});
    return table;
}

// ---- Brushes, after styling ---------------------------------------------------------------------

const Table& tableOf(const StrokePoint*) {
    using S = StrokePoint;
    static const Table table = tableWith<S>({number(
        "position", &S::position, -100, 100, "m",
        "position of the brush, relative to the head before it moves")});
    return table;
}

const Table& tableOf(const StrokeSettings*) {
    using S = StrokeSettings;
    static const Table table = tableWith<S>(
        {choice(
             "tool", &S::tool,
             {{BrushTool::comb, "comb"},
              {BrushTool::cut, "cut"},
              {BrushTool::lengthen, "lengthen"},
              {BrushTool::push, "push"},
              {BrushTool::clump, "clump"}},
             "comb: hair follows the brush; cut: strands end where they cross the path; lengthen: "
             "strands continue beyond their tips; push: hair moves away from the head; clump: tips "
             "are drawn to the path"),
         number(
             "radius", &S::radius, 0.001, 1, "m",
             "distance from the path at which the brush has no effect"),
         number(
             "strength", &S::strength, 0, 1, "1",
             "effect on the path. comb: fraction of the brush's motion that hair follows; cut: "
             "fraction of the length beyond the path that is cut off; lengthen: fraction of a "
             "strand's length that is added; push: fraction of the radius that hair moves; clump: "
             "fraction of the "
             "distance to the path that tips move"),
         list("path", &S::path, 1000, "positions of the brush, joined by straight lines")});
    return table;
}

// ---- Sources of guides --------------------------------------------------------------------------

const Table& tableOf(const FilePlacementSettings*) {
    using S = FilePlacementSettings;
    static const Table table = tableWith<S>(
        {number(
             "scale", &S::scale, 1e-6, 1e6, "1",
             "metres per unit of the file; formats that state their unit are already in metres"),
         number(
             "rotation", &S::rotation, -360, 360, "deg",
             "rotation of the strands about x, then y, then z"),
         number(
             "translation", &S::translation, -1000, 1000, "m",
             "translation of the strands, after scale and rotation")});
    return table;
}

const Table& tableOf(const CacheSettings*) {
    using S = CacheSettings;
    static const Table table = tableWith<S>(
        {choice(
             "mode", &S::mode,
             {{CacheMode::none, "none"}, {CacheMode::play, "play"}, {CacheMode::follow, "follow"}},
             "none: guides start at rest; play: they are where the file has them, with solver "
             "none; follow: the solver moves them, their roots are where the file has them, and "
             "springs and the global shape constraint pull the rest there"),
         fileName(
             "file", &S::file,
             "USD or Alembic file with samples over time of the same strands as /groom/file; "
             "empty: that file itself"),
         number(
             "strength", &S::strength, 0, 1e6, "1/s^2",
             "stiffness per mass of the critically damped springs of follow")});
    return table;
}

const Table& tableOf(const GroomSettings*) {
    using S = GroomSettings;
    static const Table table = tableWith<S>(
        {fileName(
             "file", &S::file,
             "file of strands (.hair, .tfx, .hgl, .ply, .obj, .gltf, .glb, .usd, .usda, .usdc, "
             ".usdz, .data, .npy, .npz, .xml, .bin, .abc, .mitshair, .txt, .pbrt), relative to the "
             "scene file; empty: guides are grown"),
         number(
             "points_per_strand", &S::points_per_strand, 0, 65536, "count",
             "points per strand of a PLY file that has only points, strand after strand; 0: the "
             "file divides its points into strands"),
         fileName(
             "mesh", &S::mesh,
             "mesh that the file's strands grow on; empty: none; grown guides use "
             "/groom/grow/mesh"),
         group("placement", &S::placement, "placement of the file's strands"),
         number(
             "vertices", &S::vertices, 0, 256, "count",
             "vertices per strand that the file is resampled to, at least 2; 0: as many as its "
             "longest strand has"),
         number(
             "guides", &S::guides, 0, 1000000, "count",
             "guides to grow, or to choose from the file or from grown strands; if the file flags "
             "guides, they are chosen from these, which are not drawn as strands; 0: all that the "
             "file flags, otherwise all of its strands, or 86 grown ones"),
         text(
             "groups", &S::groups,
             "numbers of the file's groups that are kept, such as \"0, 2\"; empty: all"),
         group("grow", &S::grow, "guides grown on a scalp"),
         group("style", &S::style, "styling of grown strands and of those of the file"),
         list(
             "edits", &S::edits, 1000,
             "strokes of brushes over the styled hair at rest, one after the other"),
         fileName(
             "fixed", &S::fixed,
             "file of further strands, in metres and with their widths, that only follow the head, "
             "such as brows and lashes; drawn if /strands/source is groom; empty: none"),
         group("cache", &S::cache, "motion of guides from a file")});
    return table;
}

}  // namespace hair
