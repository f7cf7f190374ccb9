#include "benchmarks/commands/command_line_options.h"
#include "benchmarks/commands/commands.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {
namespace {

constexpr const char* kConvertNotes =
    R"(Strands are edited in this order: scale, followers, vertices, guides, unit and axis.
Without --scale lengths stay as they are. Only .hgl is always in metres: the unit that IN states is
applied. An .hgl file gets root triangles if IN has none. Warnings on stderr name the data that a format
can't hold. OUT may be IN: it is replaced once all is written, and an interrupt leaves it unchanged.)";

void addPointsPerStrand(
    CLI::App& command, std::uint32_t& points, const std::string& name = "--points-per-strand") {
    command
        .add_option(
            name, points,
            "points per strand of a PLY file that has only points, strand after strand")
        ->check(CLI::Range(1, 65536));
}

void addStrict(CLI::App& command, bool& strict) {
    command.add_flag(
        "--strict", strict,
        "refuse a file with strands of a single point, with numbers that are not finite or with "
        "negative widths, instead of leaving these strands out");
}

void addGroups(CLI::App& command, std::vector<std::int32_t>& groups, const std::string& what) {
    command.add_option("--group", groups, what + " of this group; repeatable (default: all)")
        ->type_name("NUMBER")
        ->allow_extra_args(false);
}

constexpr const char* kCompareGroomsNotes =
    R"(The strands of each file are sampled evenly and compared with the polylines of the other. Precision is
the share of B that is found in A; recall is the share of A that is found in B. Strand consistency is the
largest share of a strand of A that is found in one strand of B, averaged over strands. docs/grooms.md
defines every figure.)";

constexpr const char* kGroomSceneNotes =
    R"(If a file states no unit or upward axis, the choice with the most roots on the head is used. The
share of roots, the share of the second-best choice and every other choice are printed. A head that is
not in metres with +y up is converted and written beside OUT as .head.obj, without its materials.
Then: hairbench render OUT -o x.png)";

constexpr const char* kGroomSheetNotes =
    R"(Files are found in subfolders, too, and sorted by name. A line for each has its strands, points, unit, up
axis, median length, strays and strands that were left out; "?" marks a guess. Oddities and files that can't
be read follow. Pictures show up to 4,000 strands of each file. An archive (.zip, .tar, .tar.gz, ...) of up
to 2 GiB of hair is unpacked into a temporary folder. --json has what 'hairbench groom info --json' says of
each file.)";

constexpr const char* kFilterNotes =
    R"(A strand is left out by the first test that it fails; the count for each test is printed. A root
triangle stays if all of its strands stay. OUT is in IN's unit.)";

constexpr const char* kSmoothNotes =
    R"(The directions along each strand are diffused over that arc length L, and the strand is rebuilt from its
root with its own segment lengths. The amplitude of a wave of length w is multiplied by
1 / (1 + (2 pi L / w)^2); hair gets no shorter. Tips move. OUT is in IN's unit.)";

constexpr const char* kFixNotes =
    R"(Points with a number that is not finite are left out, and a strand that loses its root begins at the
next point. Strands that have one point, have no length or repeat an earlier strand are left out, and so are
points at the place of the point before them; strands of more than 256 points are resampled to 256. With --mesh
each strand moves as a whole until its root is on the mesh, unless the root is farther off than
--farthest-root; points deeper than 1 mm inside the mesh are moved onto it, which changes lengths. With
--scale OUT is in metres. Not repaired: widths, roots that several strands share, a mesh that is not
closed, a unit that is not stated.)";

void addEditedFiles(CLI::App& command, EditGroomOptions& options) {
    command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
    command.add_option("out", options.out, "file to write; it may be IN")
        ->required()
        ->type_name("OUT");
    command
        .add_option(
            "--scale", options.scale,
            "metres per unit of IN (default: as the file states, or a guess)")
        ->check(CLI::PositiveNumber);
    addPointsPerStrand(command, options.points_per_strand);
}

template <class Value>
void addPositive(
    CLI::App& command, const std::string& name, Value& value, const std::string& description) {
    command.add_option(name, value, description)->check(CLI::PositiveNumber);
}

constexpr const char* kTransformNotes =
    R"(Changes are applied in this order: unit, upward axis, mirror image, factor, translation. Widths scale
with lengths. The upward axis changes by a quarter turn. Without --from-unit and --from-up, IN must state
its unit and axis; formats other than USD, glTF and Alembic of hairbench state no axis. .usda states unit
and axis of OUT.)";

constexpr const char* kGroupsNotes =
    R"(Lengths are in the file's unit. --renumber gives a group another number; groups that get the same number
become one. All --renumber apply at once: 1=2 and 2=1 exchange two groups.)";

CLI::Option* addChoice(
    CLI::App& command, const std::string& name, std::string& value, const std::string& description,
    const std::vector<std::string>& choices) {
    return command.add_option(name, value, description)->check(CLI::IsMember(choices));
}

const std::vector<std::string> kUnits{"m", "cm", "mm", "inch"};
const std::vector<std::string> kUpAxes{"x", "y", "z"};

void addGroomEdits(const CommandLine& line, CLI::App& groom) {
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "reverse",
         .description = "exchanges root and tip of the strands of a file of hair",
         .examples = {"hairbench groom reverse in.hair out.hair"},
         .notes = "For files that begin at the tip. OUT is in IN's unit."},
        reverseGroom, addEditedFiles);
    addCommand<TransformGroomOptions>(
        line, groom,
        {.name = "transform",
         .description =
             "changes unit and upward axis of a file of hair; mirrors, scales and moves it",
         .examples =
             {"hairbench groom transform in.hair out.usda --from-unit cm --unit m --from-up z --up "
              "y",
              "hairbench groom transform in.hair out.hair --mirror x"},
         .notes = kTransformNotes},
        transformGroom, [](CLI::App& command, TransformGroomOptions& options) {
            command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
            command.add_option("out", options.out, "file to write; it may be IN")
                ->required()
                ->type_name("OUT");
            addPointsPerStrand(command, options.points_per_strand);
            addChoice(command, "--from-unit", options.from_unit, "unit of IN", kUnits);
            addChoice(command, "--unit", options.unit, "unit of OUT", kUnits);
            addChoice(command, "--from-up", options.from_up, "upward axis of IN", kUpAxes);
            addChoice(command, "--up", options.up, "upward axis of OUT", kUpAxes);
            addChoice(
                command, "--mirror", options.mirror,
                "change the sign of this coordinate of OUT, before it is moved", kUpAxes);
            addPositive(command, "--scale", options.scale, "factor of all lengths (default 1)");
            command
                .add_option("--translate", options.translation, "move by x, y and z, in OUT's unit")
                ->expected(3)
                ->type_name("X Y Z");
        });
    addCommand<GroomGroupsOptions>(
        line, groom,
        {.name = "groups",
         .description = "lists the groups of a file of hair, and renumbers or joins them",
         .examples =
             {"hairbench groom groups in.usda",
              "hairbench groom groups in.usda out.usda --renumber 3=0 --renumber 7=0"},
         .notes = kGroupsNotes},
        groomGroups, [](CLI::App& command, GroomGroupsOptions& options) {
            command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
            command.add_option("out", options.out, "file to write, for --renumber; it may be IN")
                ->type_name("OUT");
            addPointsPerStrand(command, options.points_per_strand);
            addRepeated(
                command, "--renumber", options.renumber,
                "give group OLD the number NEW; repeatable")
                ->type_name("OLD=NEW");
            command.add_flag("--json", options.json, "print JSON");
        });
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
            addPositive(
                command, "--shortest", options.shortest, "leave out strands shorter than this, mm");
            addPositive(
                command, "--longest", options.longest, "leave out strands longer than this, mm");
            addPositive(
                command, "--fewest-points", options.fewest_points,
                "leave out strands with fewer points");
            addPositive(
                command, "--most-points", options.most_points,
                "leave out strands with more points");
            addGroups(command, options.groups, "keep strands");
            command.add_option("--mesh", options.mesh, "head, in metres")->type_name("FILE");
            addPositive(
                command, "--farthest-root", options.farthest_root,
                "leave out strands whose root is farther than this from the mesh, mm");
            addPositive(
                command, "--deepest", options.deepest,
                "leave out strands with a point deeper than this inside the mesh, mm");
        });
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "smooth",
         .description = "smooths the strands of a file of hair",
         .examples = {"hairbench groom smooth in.hair out.hair --length 10"},
         .notes = kSmoothNotes},
        smoothGroom, [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command
                .add_option("--length", options.smooth_length, "arc length L to smooth over, mm")
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
                "distance between points, as close to this as possible, mm");
        });
    addCommand<EditGroomOptions>(
        line, groom,
        {.name = "fix",
         .description = "repairs faults that 'groom info' finds, and lists the repairs",
         .examples = {"hairbench groom fix in.hair out.hair --mesh head.glb"},
         .notes = kFixNotes},
        fixGroom, [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--mesh", options.mesh, "head that the hair grows on, in metres")
                ->type_name("FILE");
            addPositive(
                command, "--farthest-root", options.farthest_root,
                "leave strands where they are if their root is farther from the mesh, mm (default "
                "10)");
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
         .description = "shows what a file of hair contains and warns of its faults",
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
                    "metres per unit of the file (default: as the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            addPointsPerStrand(command, options.points_per_strand);
            addStrict(command, options.strict);
            addGroups(command, options.groups, "show strands");
            command.add_flag("--json", options.json, "print JSON");
        });
    addCommand<GroomFormatsOptions>(
        line, *groom,
        {.name = "formats",
         .description = "lists the formats of hair and their data that are read and written",
         .examples = {"hairbench groom formats"}},
        printGroomFormats, [](CLI::App& command, GroomFormatsOptions& options) {
            command.add_flag("--markdown", options.markdown, "print the table in Markdown");
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
                    "metres per unit of FILE (default: as the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            command.add_option("--up", options.up, "upward axis of FILE (default: a guess)")
                ->check(CLI::IsMember({"x", "y", "z"}));
            addPointsPerStrand(command, options.points_per_strand);
            addStrict(command, options.strict);
            addGroups(command, options.groups, "make a scene of strands");
            command
                .add_option(
                    "--sheet", options.sheet,
                    "draw the scene from the front, its left, the back and its right (.png)")
                ->type_name("PNG");
            command.add_option(
                "--device", options.device.wanted,
                "for --sheet: index or part of the name of the device");
            command.add_flag("--force", options.force, "replace existing files");
        });
    addCommand<GroomSheetOptions>(
        line, *groom,
        {.name = "sheet",
         .description =
             "draws all files of hair of a folder or an archive, and lists their oddities",
         .examples =
             {"hairbench groom sheet hairstyles -o sheet.png",
              "hairbench groom sheet hairstyles.zip -o sheet.png --json sheet.json --head "
              "head.obj"},
         .notes = kGroomSheetNotes},
        makeGroomSheet, [](CLI::App& command, GroomSheetOptions& options) {
            command.add_option("folder", options.folder, "folder or archive of files of hair")
                ->required()
                ->type_name("FOLDER");
            command.add_option("-o,--out", options.out, "picture to write (.png)")
                ->required()
                ->type_name("PNG");
            command.add_option("--json", options.json, "file to write the table to")
                ->type_name("JSON");
            command.add_option("--head", options.head, "mesh that the hair of all files grows on")
                ->type_name("HEAD");
            command
                .add_option(
                    "--scale", options.scale,
                    "metres per unit of the files (default: as each states, or a guess)")
                ->check(CLI::PositiveNumber);
            command.add_option("--up", options.up, "upward axis of the files (default: a guess)")
                ->check(CLI::IsMember({"x", "y", "z"}));
            addPointsPerStrand(command, options.points_per_strand);
            addStrict(command, options.strict);
            command
                .add_option(
                    "--most", options.most,
                    "files to read; of more, as many are taken at equal distances")
                ->check(CLI::Range(1, 10000))
                ->capture_default_str();
            command.add_option("--size", options.size, "width of each picture in pixels")
                ->check(CLI::Range(64, 1024))
                ->capture_default_str();
            command
                .add_option(
                    "--columns", options.columns,
                    "pictures in a row (default: about as many as rows)")
                ->check(CLI::Range(1, 100));
            command.add_option(
                "--device", options.device.wanted, "index or part of the name of the device");
            command.add_flag("--force", options.force, "replace existing files");
        });
    addCommand<groom::ConvertOptions>(
        line, *groom,
        {.name = "convert",
         .description =
             "converts a file of hair to another format: " + hair::groom::writtenExtensions(),
         .examples =
             {"hairbench groom convert mine.hair guides.hgl --guides 200 --vertices 16 --scale "
              "0.01",
              "hairbench groom convert mine.hair mine.usda",
              "hairbench groom convert mine.usda mine.abc --for unreal"},
         .notes = kConvertNotes},
        convertGroom, [](CLI::App& command, groom::ConvertOptions& options) {
            command.add_option("in", options.in, "file of hair")->required()->type_name("IN");
            command.add_option("out", options.out, "file to write")->required()->type_name("OUT");
            addPointsPerStrand(command, options.points_per_strand);
            addStrict(command, options.strict);
            command
                .add_option(
                    "--scale", options.scale,
                    "metres per unit of IN (0.01: centimetres); OUT is in metres or in --unit")
                ->check(CLI::PositiveNumber);
            addChoice(command, "--unit", options.unit, "unit of OUT", kUnits);
            addChoice(command, "--up", options.up, "upward axis of OUT", kUpAxes);
            addChoice(
                command, "--from-up", options.from_up,
                "upward axis of IN (default: as the file states)", kUpAxes);
            addChoice(
                command, "--for", options.program,
                "program that reads OUT (.abc, .usda): its unit, upward axis and names of data",
                groom::programNames());
            command.add_option(
                "--followers", options.followers,
                "number of followers round each strand, as TressFX makes them");
            command
                .add_option(
                    "--follower-radius", options.follower_radius,
                    "radius of the disc round a strand in which its followers lie, in IN's unit")
                ->check(CLI::NonNegativeNumber);
            command
                .add_option(
                    "--tip-separation", options.tip_separation,
                    "factor of the followers' displacement at the tip (default 1)")
                ->check(CLI::NonNegativeNumber);
            command.add_option(
                "--vertices", options.vertices,
                "points per strand, evenly spaced by arc length (2 to 65536)");
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
         .description = "measures how similar two files of hair are, by published metrics",
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
                    "head, in metres; the share of each file inside it is printed")
                ->type_name("FILE");
            command
                .add_option(
                    "--scale-a", options.first_scale,
                    "metres per unit of A (default: as the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--scale-b", options.second_scale,
                    "metres per unit of B (default: as the file states, or a guess)")
                ->check(CLI::PositiveNumber);
            addPointsPerStrand(command, options.first_points_per_strand, "--points-per-strand-a");
            addPointsPerStrand(command, options.second_points_per_strand, "--points-per-strand-b");
            addRepeated(
                command, "--threshold", options.thresholds,
                "greatest distance in mm and angle in degrees at which a point counts as found; "
                "repeatable (default 2/20, 3/30, 4/40)")
                ->type_name("MM/DEGREES");
            command
                .add_option(
                    "--spacing", options.spacing,
                    "greatest distance between samples along strands, mm (default 2)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--curvature-step", options.curvature_step,
                    "arc length over which curvature is measured, mm (default 5)")
                ->check(CLI::PositiveNumber);
            command.add_option(
                "--consistency-samples", options.consistency_samples,
                "samples per strand for strand consistency (default 16); 0: all");
            command.add_flag(
                "--undirected", options.undirected,
                "ignore the direction of strands, for a B that does not tell root from tip");
            command.add_option(
                "--threads", options.threads, "number of threads (default: one per processor)");
            command.add_flag("--json", options.json, "print JSON");
            command.add_option("-o,--out", options.out, "write JSON to a file")->type_name("FILE");
        });
    addGroomEdits(line, *groom);
}

}  // namespace benchmarks::commands
