#include "benchmarks/commands/command_line_options.h"
#include "benchmarks/commands/commands.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {
namespace {

constexpr const char* kConvertNotes =
    R"(Strands are edited in this order: scale, followers, vertices, guides.
Without --scale lengths stay as they are, but that .hgl is always in metres: what IN states of its
unit is applied. .hgl gets root triangles if IN has none. What a format can't hold is said on
stderr. OUT may be IN; it is replaced when all is written, and an interrupt leaves it alone.)";

void addPointsPerStrand(
    CLI::App& command, std::uint32_t& points, const std::string& name = "--points-per-strand") {
    command
        .add_option(
            name, points,
            "points of each strand of a PLY file that has points alone, strand after strand")
        ->check(CLI::Range(1, 65536));
}

constexpr const char* kCompareGroomsNotes =
    R"(Samples, evenly along the strands of one file, are held against the polylines of the other. Precision
is the share of B that is found in A, recall that of A found in B. Strand consistency is the greatest
share of a strand of A that is found in one strand of B, mean over strands. docs/grooms.md
defines all that is printed.)";

constexpr const char* kGroomSceneNotes =
    R"(Units and axes that files do not state are those in which the most roots lie on the head; the share,
that of the second best and every other choice are printed. A head that is not in metres with +y up is
copied beside OUT as .head.obj, in those, without its materials. Then: hairbench render OUT -o x.png)";

constexpr const char* kFilterNotes =
    R"(A strand is left out by the first test that it fails; how many each test leaves out is printed. Root
triangles stay whose strands all stay. OUT is in IN's unit.)";

constexpr const char* kSmoothNotes =
    R"(The directions along each strand diffuse by that length of arc, and the strand is put together again
from its root with the lengths of its segments: waves of a length w become smaller by
1 / (1 + (2 pi MM / w)^2), and hair no shorter. Tips move. OUT is in IN's unit.)";

constexpr const char* kFixNotes =
    R"(Strands of one point, without length and equal to one before them are left out, so are points at the
place of the one before them; strands of more than 256 points get 256. With --mesh strands move whole
until their root is on the mesh, unless it is farther than --farthest-root, and points deeper than 1 mm
inside it are put onto it, which changes lengths. With --scale OUT is in metres. What is left to a
person: widths, roots that several strands share, a mesh that is not closed, a unit that is not stated.
Files whose numbers are not finite are not read at all.)";

void addEditedFiles(CLI::App& command, EditGroomOptions& options) {
    command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
    command.add_option("out", options.out, "file to write; it may be IN")
        ->required()
        ->type_name("OUT");
    command
        .add_option(
            "--scale", options.scale,
            "metres in IN's unit (default what the file states, or a guess)")
        ->check(CLI::PositiveNumber);
    addPointsPerStrand(command, options.points_per_strand);
}

template <class Value>
void addPositive(
    CLI::App& command, const std::string& name, Value& value, const std::string& description) {
    command.add_option(name, value, description)->check(CLI::PositiveNumber);
}

void addGroomEdits(const CommandLine& line, CLI::App& groom) {
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "filter",
         .description = "leaves strands out of a file of hair",
         .examples =
             {"hairbench groom filter in.hair out.hair --shortest 5 --fewest-points 4",
              "hairbench groom filter in.hair out.hair --mesh head.glb --farthest-root 3"},
         .notes = kFilterNotes},
        filterGroom, [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            addPositive(command, "--shortest", options.shortest, "leave out shorter strands, mm");
            addPositive(command, "--longest", options.longest, "leave out longer strands, mm");
            addPositive(
                command, "--fewest-points", options.fewest_points,
                "leave out strands of fewer points");
            addPositive(
                command, "--most-points", options.most_points, "leave out strands of more points");
            command.add_option("--mesh", options.mesh, "head, in metres")->type_name("FILE");
            addPositive(
                command, "--farthest-root", options.farthest_root,
                "leave out strands whose root is farther from the mesh, mm");
            addPositive(
                command, "--deepest", options.deepest,
                "leave out strands with a point deeper inside the mesh, mm");
        });
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "smooth",
         .description = "smooths the strands of a file of hair",
         .examples = {"hairbench groom smooth in.hair out.hair --length 10"},
         .notes = kSmoothNotes},
        smoothGroom, [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--length", options.smooth_length, "arc to smooth over, mm")
                ->required()
                ->check(CLI::PositiveNumber);
        });
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "resample",
         .description = "spaces the points of strands evenly by arc length",
         .examples =
             {"hairbench groom resample in.hair out.hair --vertices 16",
              "hairbench groom resample in.hair out.hair --spacing 5"}},
        resampleGroom, [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--vertices", options.vertices, "points per strand (2 to 65536)")
                ->check(CLI::Range(2u, 65536u));
            addPositive(
                command, "--spacing", options.spacing,
                "distance of points, as near to it as goes, mm");
        });
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "fix",
         .description = "mends what 'groom info' finds, and says what it did",
         .examples = {"hairbench groom fix in.hair out.hair --mesh head.glb"},
         .notes = kFixNotes},
        fixGroom, [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--mesh", options.mesh, "head that the hair grows on, in metres")
                ->type_name("FILE");
            addPositive(
                command, "--farthest-root", options.farthest_root,
                "roots that are farther off the mesh stay, mm (default 10)");
        });
}

}  // namespace

void addGroomCommands(const CommandLine& line) {
    CLI::App* const groom = addPlainCommand(
        line, line.app,
        {.name = "groom",
         .description = "inspects, compares, converts and edits files of hair",
         .examples = {"hairbench groom info mine.hair --mesh head.glb"}});
    groom->require_subcommand(1);
    addCommand<GroomInfoOptions>(
        line, *groom,
        {.name = "info",
         .description = "says what is in a file of hair and what is odd about it",
         .examples = {"hairbench groom info mine.hair --mesh head.glb"}},
        inspectGroom, [](CLI::App& command, GroomInfoOptions& options) {
            command.add_option("file", options.file, "file of hair")->required()->type_name("FILE");
            command
                .add_option(
                    "--mesh", options.mesh,
                    "mesh that the hair grows on, to find roots that are off it")
                ->type_name("FILE");
            command
                .add_option(
                    "--scale", options.scale,
                    "metres in the file's unit (default what the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            addPointsPerStrand(command, options.points_per_strand);
            command.add_flag("--json", options.json, "print JSON");
        });
    addCommand<GroomSceneOptions>(
        line, *groom,
        {.name = "scene",
         .description = "makes a scene of a file of hair and a head",
         .examples = {"hairbench groom scene mine.hair --head head.glb -o mine.json"},
         .notes = kGroomSceneNotes},
        makeGroomScene, [](CLI::App& command, GroomSceneOptions& options) {
            command.add_option("file", options.hair, "file of hair")->required()->type_name("FILE");
            command
                .add_option("--head", options.head, "mesh that the hair grows on and collides with")
                ->type_name("HEAD");
            command.add_option("-o,--out", options.out, "scene file to write (.json)")
                ->required()
                ->type_name("OUT");
            command
                .add_option(
                    "--scale", options.scale,
                    "metres in FILE's unit (default what the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            command.add_option("--up", options.up, "axis that is up in FILE (default a guess)")
                ->check(CLI::IsMember({"x", "y", "z"}));
            addPointsPerStrand(command, options.points_per_strand);
            command
                .add_option(
                    "--sheet", options.sheet,
                    "draw the scene from the front, its left, the back and its right (.png)")
                ->type_name("PNG");
            command.add_option(
                "--device", options.device.wanted,
                "for --sheet: index or part of the name of the device");
            command.add_flag("--force", options.force, "replace files that are there");
        });
    addCommand<groom::ConvertOptions>(
        line, *groom,
        {.name = "convert",
         .description = "writes a file of hair as another: " + hair::groom::writtenExtensions(),
         .examples =
             {"hairbench groom convert mine.hair guides.hgl --guides 200 --vertices 16 --scale "
              "0.01",
              "hairbench groom convert mine.hair mine.usda"},
         .notes = kConvertNotes},
        convertGroom, [](CLI::App& command, groom::ConvertOptions& options) {
            command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
            command.add_option("out", options.out, "file to write")->required()->type_name("OUT");
            addPointsPerStrand(command, options.points_per_strand);
            command
                .add_option(
                    "--scale", options.scale,
                    "metres in IN's unit (0.01: centimetres); OUT is in metres")
                ->check(CLI::PositiveNumber);
            command.add_option(
                "--followers", options.followers,
                "number of copies round each strand, as TressFX makes them");
            command
                .add_option(
                    "--follower-radius", options.follower_radius,
                    "radius of the disc round a strand that its followers are in, in IN's unit")
                ->check(CLI::NonNegativeNumber);
            command
                .add_option(
                    "--tip-separation", options.tip_separation,
                    "factor of the followers' displacement at the tip (default 1)")
                ->check(CLI::NonNegativeNumber);
            command.add_option(
                "--vertices", options.vertices,
                "points per strand, even by arc length (2 to 65536)");
            command
                .add_option(
                    "--guides", options.guides,
                    "number of strands to keep, spread over roots and shapes")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--mesh", options.mesh,
                    "mesh that the hair grows on, in metres: root triangles of OUT.hgl lie on it")
                ->type_name("FILE");
            command.add_option(
                "--seed", options.seed,
                "seed of the followers and of the choice of guides (default 1)");
        });
    addCommand<CompareGroomsOptions>(
        line, *groom,
        {.name = "compare",
         .description = "says how alike two files of hair are, by the measures of papers",
         .examples = {"hairbench groom compare truth.hair mine.hair --mesh head.glb"},
         .notes = kCompareGroomsNotes},
        compareGrooms, [](CLI::App& command, CompareGroomsOptions& options) {
            command.add_option("a", options.first, "file of hair: the reference")
                ->required()
                ->type_name("A");
            command.add_option("b", options.second, "file of hair")->required()->type_name("B");
            command
                .add_option(
                    "--mesh", options.mesh,
                    "head, in metres, to say how much of either is inside it")
                ->type_name("FILE");
            command
                .add_option(
                    "--scale-a", options.first_scale,
                    "metres in A's unit (default what the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            command.add_option("--scale-b", options.second_scale, "metres in B's unit")
                ->check(CLI::PositiveNumber);
            addPointsPerStrand(command, options.first_points_per_strand, "--points-per-strand-a");
            addPointsPerStrand(command, options.second_points_per_strand, "--points-per-strand-b");
            addRepeated(
                command, "--threshold", options.thresholds,
                "when a point counts as found: distance in mm and angle in degrees; repeatable "
                "(default 2/20, 3/30, 4/40)")
                ->type_name("MM/DEGREES");
            command
                .add_option(
                    "--spacing", options.spacing,
                    "greatest distance of samples along strands, mm (default 2)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--curvature-step", options.curvature_step,
                    "arc that curvature is taken over, mm (default 5)")
                ->check(CLI::PositiveNumber);
            command.add_option(
                "--consistency-samples", options.consistency_samples,
                "samples of a strand that its consistency is made of (default 16); 0: all");
            command.add_flag(
                "--undirected", options.undirected,
                "strands that run opposite ways are alike: B does not know root from tip");
            command.add_option(
                "--threads", options.threads, "threads (default as many as there are processors)");
            command.add_flag("--json", options.json, "print JSON");
            command.add_option("-o,--out", options.out, "write JSON to a file")->type_name("FILE");
        });
    addGroomEdits(line, *groom);
}

}  // namespace benchmarks::commands
