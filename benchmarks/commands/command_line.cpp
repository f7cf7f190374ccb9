#include "benchmarks/commands/command_line.h"

#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/memory_need.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/exporters.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/process.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {
namespace {

constexpr const char* kExamples = R"(Examples:
  hairbench run scenes/thesis.json -a /strands/density=16,32,64 -a /render/msaa=1,4
  hairbench run scenes/thesis.json --filter 'guides:86/.*msaa:1' --out results/mine.json
  hairbench run scenes/full.json --resume
  hairbench merge part*.json -o whole.json
  hairbench report results/mine.json -o mine.html
  hairbench gate --a build/old --b build/new --scene scenes/smoke.json
  hairbench ablate scenes/rest.json
  hairbench doctor
  hairbench render scenes/strong_wind.json -o wind.png --frame 60
  hairbench render scenes/strong_wind.json -o out/%04d.png --frames 0:240
  hairbench validate scenes/*.json
  hairbench groom info hair.hair --mesh head.glb
  hairbench groom scene hair.hair --head head.glb -o hair.json
  hairbench groom convert hair.hair guides.hgl --guides 200 --vertices 16 --scale 0.01
  hairbench simulate scenes/nod.json --frames 60 --export nod.usda
  hairbench reference scenes/strong_wind.json -o truth.exr --samples 256
  hairbench diff truth.exr picture.png -o difference.png
  hairbench lod scenes/rest.json --from 0.5 --to 20 --steps 40 -o lod.json
  hairbench physics --solver rod --check 'cantilever|catenary'
Exit status: 0 ok, 1 internal error or a full disk, 2 usage or invalid scene, 3 a check of the
physics or of doctor failed, 10 slower, 11 inconclusive, 12 pictures or states differ, 13 no such
baseline or one of something else, 14 nothing ran, 77 no suitable device, 130 interrupted (what was
done is saved) or merged with cases missing.)";

// What the parsed command line asks for.
using Command = std::function<int()>;

// Where commands are added: the one that is parsed puts what it does into `chosen`. `arguments` is
// the whole command line, as reports quote it.
struct CommandLine {
    CLI::App& app;
    Command& chosen;
    const std::vector<std::string>& arguments;
};

// A command whose options live as long as the app.
// What CLI11 reads as numbers, and nobody means.
std::string whyNotFinite(std::string& text) {
    return text.find_first_of("nN") == std::string::npos ? "" : "'" + text + "' is not finite";
}

template <class Options>
CLI::App* addCommand(
    const CommandLine& line, CLI::App& parent, const std::string& name,
    const std::string& description, int (*run)(const Options&),
    const std::function<void(CLI::App&, Options&)>& add_options) {
    CLI::App* const command = parent.add_subcommand(name, description);
    const auto options = std::make_shared<Options>();
    if constexpr (requires { options->command; }) options->command = line.arguments;
    add_options(*command, *options);
    for (CLI::Option* const option : command->get_options({}))
        if (option->get_type_name().starts_with("FLOAT"))
            option->check(CLI::Validator(whyNotFinite, ""));
    command->callback([&chosen = line.chosen, options, run] {
        chosen = [options, run] { return run(*options); };
    });
    return command;
}

// ---- Options that several commands have ---------------------------------------------------------

// "2%" and "0.02" -> 0.02
std::string asShare(std::string& text) {
    if (!text.ends_with('%')) return {};
    text.pop_back();
    try {
        std::size_t used = 0;
        const double percent = std::stod(text, &used);
        if (used != text.size()) return "'" + text + "%' is no share";
        std::ostringstream share;
        share << percent / 100.0;
        text = share.str();
    } catch (const std::exception&) {
        return "'" + text + "%' is no share";
    }
    return {};
}

CLI::Option* addRepeated(
    CLI::App& command, const std::string& name, std::vector<std::string>& values,
    const std::string& description) {
    return command.add_option(name, values, description)
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
}

void addDeviceOptions(CLI::App& command, engine::DeviceOptions& options) {
    command.add_option(
        "--device", options.wanted,
        "index or part of the name of the device (see 'hairbench devices')");
    command.add_flag_callback(
        "--validate", [&options] { options.validation = engine::Validation::on; },
        "run under the Vulkan validation layer and look for missing barriers; slow");
}

void addCacheOption(CLI::App& command, scene::SceneOptions& options) {
    command.add_flag_callback(
        "--no-cache", [&options] { options.cache = false; },
        "bake distance fields and settle hair anew, and keep neither on disk");
}

void addOutsideOption(CLI::App& command, scene::Outside& outside) {
    command.add_flag_callback(
        "--allow-outside", [&outside] { outside = scene::Outside::allowed; },
        "let scenes name files outside of their folder");
}

void addSceneOptions(CLI::App& command, scene::SceneOptions& options) {
    command.add_option("scene", options.scene, "scene file (.json)")->required()->type_name("FILE");
    addRepeated(
        command, "-a,--axis", options.axes,
        "replaces or adds an axis of the sweep: /strands/density=16,32, /groom/guides=pow2:6:12")
        ->type_name("POINTER=V1,V2");
    addRepeated(
        command, "--set", options.sets, "sets a field of every case; it is not in their names")
        ->type_name("POINTER=VALUE");
    addDeviceOptions(command, options.device);
    addCacheOption(command, options);
    addOutsideOption(command, options.outside);
}

void addSamplingOptions(CLI::App& command, scene::SceneOptions& options) {
    command.add_option("--frames", options.frames, "frames of a round (/run/frames)");
    command.add_option(
        "--warmup", options.warmup, "warm-up frames before each round (/run/warmup)");
    command
        .add_option(
            "--precision", options.precision,
            "half width of the median's confidence interval, relative to it, at which rounds end "
            "(default 1%)")
        ->transform(CLI::Validator(asShare, "SHARE"));
    command.add_option(
        "--max-time", options.max_time,
        "seconds for the rounds of each mode (default 10); 0: one round");
}

void addVerdictOptions(CLI::App& command, report::VerdictOptions& options) {
    command
        .add_option(
            "--threshold", options.threshold, "largest change that counts as none (default 2%)")
        ->transform(CLI::Validator(asShare, "SHARE"))
        ->check(CLI::Range(0.0, 10.0));
    command
        .add_option(
            "--metrics", options.metrics,
            "judge the metrics whose name matches (default the times of frames and passes; on a "
            "software device their CPU time)")
        ->type_name("REGEX");
    command
        .add_option_function<std::string>(
            "--fail-on", [&options](const std::string&) { options.fail_on_inconclusive = true; },
            "inconclusive: exit with 11 where nothing is slower but not all is known")
        ->check(CLI::IsMember({"inconclusive"}));
}

// ---- physics, validate, schema, devices ---------------------------------------------------------

void addCheckCommands(const CommandLine& line) {
    addCommand<PhysicsOptions>(
        line, line.app, "physics", "holds the solvers against theory and writes a report",
        checkPhysics, [](CLI::App& command, PhysicsOptions& options) {
            addRepeated(
                command, "--solver", options.solvers, "solver to check; repeatable (default all)")
                ->type_name("NAME");
            command.add_option("--check", options.check, "run the checks whose name matches")
                ->type_name("REGEX");
            command
                .add_option(
                    "--out", options.out, "report file (default results/local/physics.json)")
                ->type_name("FILE");
            addDeviceOptions(command, options.device);
        });

    addCommand<ValidateOptions>(
        line, line.app, "validate", "checks scene files and their assets", validateScenes,
        [](CLI::App& command, ValidateOptions& options) {
            command.add_option("scenes", options.scenes, "scene files")
                ->required()
                ->type_name("FILE...");
            addOutsideOption(command, options.outside);
            command.add_flag(
                "--start", options.start,
                "settle each scene's hair on the device, its axes apart, and say what is wrong "
                "with it: stretched, inside a body, still moving, not balanced");
            command.add_option(
                "--device", options.device.wanted,
                "for --start: index or part of the name of the device");
        });
    line.app.add_subcommand("schema", "prints the JSON Schema of scene files")
        ->callback([&chosen = line.chosen] { chosen = printSchema; });
    line.app.add_subcommand("devices", "lists the Vulkan devices and what they lack")
        ->callback([&chosen = line.chosen] { chosen = printDevices; });
}

// ---- groom --------------------------------------------------------------------------------------

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
share of a strand of A that is found in one strand of B, mean over strands. docs/groom_compare.md
defines all that is printed.)";

constexpr const char* kGroomSceneNotes =
    R"(Units and axes that files do not state are those in which the most roots lie on the head; the share,
that of the second best and every other choice are printed. A head that is not in metres with +y up is
copied beside SCENE as .head.obj, in those, without its materials. Then: hairbench render SCENE -o x.png)";

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
        line, groom, "filter", "leaves strands out of a file of hair", filterGroom,
        [](CLI::App& command, EditGroomOptions& options) {
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
            command.footer(kFilterNotes);
        });
    addCommand<EditGroomOptions>(
        line, groom, "smooth", "smooths the strands of a file of hair", smoothGroom,
        [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--length", options.smooth_length, "arc to smooth over, mm")
                ->required()
                ->check(CLI::PositiveNumber);
            command.footer(kSmoothNotes);
        });
    addCommand<EditGroomOptions>(
        line, groom, "resample", "spaces the points of strands evenly by arc length", resampleGroom,
        [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--vertices", options.vertices, "points per strand (2 to 65536)")
                ->check(CLI::Range(2u, 65536u));
            addPositive(
                command, "--spacing", options.spacing,
                "distance of points, as near to it as goes, mm");
        });
    addCommand<EditGroomOptions>(
        line, groom, "fix", "mends what 'groom info' finds, and says what it did", fixGroom,
        [](CLI::App& command, EditGroomOptions& options) {
            addEditedFiles(command, options);
            command.add_option("--mesh", options.mesh, "head that the hair grows on, in metres")
                ->type_name("FILE");
            addPositive(
                command, "--farthest-root", options.farthest_root,
                "roots that are farther off the mesh stay, mm (default 10)");
            command.footer(kFixNotes);
        });
}

void addGroomCommands(const CommandLine& line) {
    CLI::App* const groom =
        line.app.add_subcommand("groom", "inspects, compares, converts and edits files of hair");
    groom->require_subcommand(1);
    addCommand<GroomInfoOptions>(
        line, *groom, "info", "says what is in a file of hair and what is odd about it",
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
        line, *groom, "scene", "makes a scene of a file of hair and a head", makeGroomScene,
        [](CLI::App& command, GroomSceneOptions& options) {
            command.add_option("file", options.hair, "file of hair")->required()->type_name("FILE");
            command
                .add_option("--head", options.head, "mesh that the hair grows on and collides with")
                ->type_name("HEAD");
            command.add_option("-o,--out", options.out, "scene file to write (.json)")
                ->required()
                ->type_name("SCENE");
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
            command.footer(kGroomSceneNotes);
        });
    addCommand<groom::ConvertOptions>(
        line, *groom, "convert",
        "writes a file of hair as another: " + hair::groom::writtenExtensions(), convertGroom,
        [](CLI::App& command, groom::ConvertOptions& options) {
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
            command.footer(kConvertNotes);
        });
    addCommand<CompareGroomsOptions>(
        line, *groom, "compare", "says how alike two files of hair are, by the measures of papers",
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
            command.footer(kCompareGroomsNotes);
        });
    addGroomEdits(line, *groom);
}

// ---- run, gate, ablate, doctor ------------------------------------------------------------------

constexpr const char* kGateNotes =
    R"(A and B are a build folder, a program, or a command line that 'run SCENE --out FILE ...' is added to;
one with {scene} and {out} in it is taken as it is. Whole processes run as A B, B A, A B ...; a sample
is a process's median. After 12, 24 and 48 pairs verdicts are passed; it is over if no metric is
inconclusive or one has regressed. One that is stopped gives the verdicts that were passed last. Exit
status: 0 nothing is slower, 10 something is, 11 inconclusive (--fail-on inconclusive), 12 pictures or
states differ, 130 interrupted before the first verdict.)";

void addRunOptions(CLI::App& command, run::RunOptions& options) {
    addSceneOptions(command, options.scene);
    addSamplingOptions(command, options.scene);
    command.add_option("--filter", options.filter, "run the cases whose name matches")
        ->type_name("REGEX");
    command.add_option("-o,--out", options.out, "report file (default results/local/<scene>.json)")
        ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--clocks",
            [&options](const std::string& clocks) {
                if (clocks == "both")
                    options.scene.axes.emplace_back("/run/clocks=locked,free");
                else
                    options.scene.sets.push_back("/run/clocks=" + clocks);
            },
            "locked: lock the GPU's clocks at what it sustains, where the user may; free: only "
            "where nobody holds them; both: each case with either (/run/clocks)")
        ->check(CLI::IsMember({"locked", "free", "both"}));
    command.add_flag("--list", options.list, "print the cases' names and stop");
    command.add_flag(
        "--dry-run", options.dry_run, "say what would run, estimate time and memory in seconds");
    command
        .add_option_function<std::string>(
            "--max-memory",
            [&options](const std::string& size) {
                options.max_memory = measure::parseMemorySize(size);
            },
            "skip cases that need more than SIZE (500M, 2G) of the device's memory, or of the "
            "host's; on a software device of both together")
        ->type_name("SIZE")
        ->check([](const std::string& size) -> std::string {
            try {
                measure::parseMemorySize(size);
                return {};
            } catch (const engine::Error& error) {
                return error.what();
            }
        });
    command.add_option(
        "--order-seed", options.order_seed,
        "seed of the order in which cases run (default: random)");
    command.add_flag("--resume", options.resume, "go on where an interrupted or killed run ended");
    command
        .add_option("--shard", options.shard, "run one part of the cases: 2/8 is the second of 8")
        ->type_name("I/N");
    command.add_flag_callback(
        "--no-pictures", [&options] { options.pictures = false; },
        "no pictures of the cases beside the report");
    command.add_option("--save-baseline", options.save_baseline, "keep the report under this name")
        ->type_name("NAME");
    command
        .add_option(
            "--baseline", options.baseline,
            "compare with the report that --save-baseline kept under this name")
        ->type_name("NAME");
    addVerdictOptions(command, options.verdict);
}

void addGateOptions(CLI::App& command, gate::GateOptions& options) {
    command.add_option("--a", options.a, "what to compare with")
        ->required()
        ->type_name("CMD_OR_BUILD");
    command.add_option("--b", options.b, "what may be slower")
        ->required()
        ->type_name("CMD_OR_BUILD");
    command.add_option("--scene", options.scene.scene, "scene file")->required()->type_name("FILE");
    // No -a beside --a: newer CLI11 takes them for one name.
    addRepeated(command, "--axis", options.scene.axes, "replaces or adds an axis of the sweep")
        ->type_name("POINTER=V1,V2");
    addRepeated(command, "--set", options.scene.sets, "sets a field of every case of A and B")
        ->type_name("POINTER=VALUE");
    addRepeated(command, "--set-a", options.a_sets, "sets a field of every case of A alone")
        ->type_name("POINTER=VALUE");
    addRepeated(command, "--set-b", options.b_sets, "sets a field of every case of B alone")
        ->type_name("POINTER=VALUE");
    addSamplingOptions(command, options.scene);
    addCacheOption(command, options.scene);
    addOutsideOption(command, options.scene.outside);
    command.add_option(
        "--device", options.scene.device.wanted,
        "index or part of the name of the device (see 'hairbench devices')");
    command.add_option("--filter", options.filter, "run the cases whose name matches")
        ->type_name("REGEX");
    command.add_option("--pairs", options.pairs, "pairs before the first verdict (default 12)")
        ->check(CLI::IsMember({12, 24, 48}));
    command
        .add_option(
            "--calibrate", options.calibration,
            "pairs of A with itself first: changes that A has by itself count as none (default 0)")
        ->check(CLI::Range(0, 256));
    addVerdictOptions(command, options.verdict);
    command
        .add_option(
            "--smallest-share", options.verdict.smallest_share,
            "passes that are less of their frame decide nothing (default 0.02)")
        ->check(CLI::Range(0.0, 1.0));
    command.add_flag(
        "--all", options.all, "go on after a regression until nothing is inconclusive");
    command
        .add_option(
            "--max-minutes", options.max_minutes,
            "time after which no process is begun; the verdicts passed last are given")
        ->check(CLI::PositiveNumber);
    command.add_option("-o,--out", options.out, "report (default results/local/gate-<scene>.json)")
        ->type_name("FILE");
    command.footer(kGateNotes);
}

void addAblateOptions(CLI::App& command, AblateOptions& options) {
    addSceneOptions(command, options.scene);
    addSamplingOptions(command, options.scene);
    command.add_option("--filter", options.filter, "run the cases whose name matches")
        ->type_name("REGEX");
    command.add_option("--passes", options.passes, "times up and down the ladder (default 8)")
        ->check(CLI::Range(2, 1000));
    command
        .add_option("-o,--out", options.out, "report (default results/local/ablation-<scene>.json)")
        ->type_name("FILE");
}

void addDoctorOptions(CLI::App& command, DoctorOptions& options) {
    addDeviceOptions(command, options.device);
    command
        .add_option(
            "--pairs", options.pairs,
            "pairs of equal processes from which the smallest slowdown that a gate can find here "
            "is "
            "estimated (48 for a firm answer; default 0: no estimate)")
        ->check(CLI::Range(0, 256));
    command.add_flag(
        "--planted", options.planted,
        "plant slowdowns of 1.5 times the smallest in one pass and say whether a gate finds them; "
        "takes long");
    command.add_option("-o,--out", options.out, "findings as JSON")->type_name("FILE");
    command
        .add_option(
            "--rules", options.rules,
            "holds a report against the twelve rules of Hoefler and Belli (SC 2015) instead of "
            "looking at the machine")
        ->type_name("REPORT")
        ->excludes("--pairs")
        ->excludes("--planted")
        ->excludes("--out");
}

void addMeasuringCommands(const CommandLine& line) {
    addCommand<run::RunOptions>(
        line, line.app, "run", "plays a scene's or a suite's cases and writes a report", runScene,
        addRunOptions);
    addCommand<gate::GateOptions>(
        line, line.app, "gate", "decides whether build B is slower than build A", gateBuilds,
        addGateOptions);
    addCommand<AblateOptions>(
        line, line.app, "ablate",
        "measures what each stage of the strands costs, by frames without it", ablateScene,
        addAblateOptions);
    addCommand<DoctorOptions>(
        line, line.app, "doctor", "says whether timings of this machine can be trusted, and why",
        examineMachine, addDoctorOptions);
}

// ---- view, render, simulate, export, reference, diff, lod ---------------------------------------

constexpr const char* kLodNotes =
    R"(The hair of one frame stands still; the camera keeps its direction. Error: root mean square of
the picture with /lod's levels less that of level 0, display values counting from 0 to 1. Popping:
root mean square of what changes from one place to the next, less what changes at level 0. Coverage: share
of a square round the hair that it hides, without the head. Times: medians of isolated frames.
With --reference: whole levels, each lit by one directional light that many degrees from the camera, against level
0 path-traced; popping is what the last 0.05 of the level change.)";

void addPictureCommands(const CommandLine& line) {
    addCommand<viewer::ViewOptions>(
        line, line.app, "view", "opens a scene in a window", viewScene,
        [](CLI::App& command, viewer::ViewOptions& options) {
            addSceneOptions(command, options.scene);
            command.add_option("--width", options.width, "width of the window (default 1600)");
            command.add_option("--height", options.height, "height of the window (default 900)");
            command.add_option(
                "--scale", options.scale, "scale of letters and widgets (default the screen's)");
            command.add_option(
                "--frames", options.frames,
                "frames that the window draws before it closes (default: until it is closed)");
            command
                .add_option(
                    "--screenshot", options.screenshot, "picture of the window's last frame (.png)")
                ->type_name("FILE");
            command
                .add_option(
                    "--script", options.script,
                    "steps that drive the viewer as a user would (docs/viewer.md)")
                ->type_name("FILE");
            command
                .add_option(
                    "--shaders", options.shaders,
                    "folder whose GLSL is watched and reloaded (default: where it was built)")
                ->type_name("FOLDER");
            command
                .add_option(
                    "--preferences", options.preferences,
                    "file that remembers layout and theme (default: the user's own; with --script "
                    "none)")
                ->type_name("FILE");
        });
    addCommand<RenderOptions>(
        line, line.app, "render", "writes pictures of one frame or several", renderScene,
        [](CLI::App& command, RenderOptions& options) {
            addSceneOptions(command, options.scene);
            command
                .add_option(
                    "-o,--out", options.out,
                    "picture: .png as a display shows it, .exr linear light without exposure and "
                    "tone map; "
                    "of several frames with their number in it, as in out/%04d.png")
                ->required()
                ->type_name("FILE");
            CLI::Option* frame =
                command.add_option("--frame", options.frame, "frame to draw, from 0 (default 0)")
                    ->check(CLI::Range(0, 1'000'000));
            command
                .add_option(
                    "--frames", options.frames,
                    "frames to draw: A, A+1 ... below B, or every STEPth")
                ->type_name("A:B[:STEP]")
                ->excludes(frame);
        });
    addCommand<SimulateOptions>(
        line, line.app, "simulate", "plays a scene and writes its strands, without a picture",
        simulateScene, [](CLI::App& command, SimulateOptions& options) {
            addSceneOptions(command, options.scene);
            command.add_option("--frames", options.recording.frames, "frames to play (default 60)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--export", options.recording.out,
                    "file; .usda holds every frame, other formats (see 'groom convert') the last")
                ->required()
                ->type_name("FILE");
            command.add_flag(
                "--guides", options.recording.guides, "the guides instead of the drawn strands");
        });
    addCommand<ExportOptions>(
        line, line.app, "export", "writes one frame as a scene of another renderer", exportScene,
        [](CLI::App& command, ExportOptions& options) {
            addSceneOptions(command, options.scene);
            command
                .add_option(
                    "--mitsuba", options.mitsuba, "folder for a Mitsuba 3 scene (scene.xml)")
                ->required()
                ->type_name("DIR");
            command.add_option("--frame", options.frame, "frame to write, from 0 (default 0)");
        });
    addCommand<ReferenceOptions>(
        line, line.app, "reference",
        "path-traces one frame with Mitsuba 3 (scripts/setup --reference)", renderReference,
        [](CLI::App& command, ReferenceOptions& options) {
            addSceneOptions(command, options.scene);
            command.add_option("-o,--out", options.out, "picture (.exr linear, .png sRGB)")
                ->required()
                ->type_name("FILE");
            command.add_option("--samples", options.samples, "samples per pixel (default 64)")
                ->check(CLI::Range(1, 1'000'000));
            command.add_option("--frame", options.frame, "frame to draw, from 0 (default 0)");
        });
    addCommand<DiffOptions>(
        line, line.app, "diff",
        "compares pictures: RMSE, PSNR, SSIM, FLIP (scripts/setup --reference)", diffPictures,
        [](CLI::App& command, DiffOptions& options) {
            command.add_option("a", options.reference, "reference (.png .exr)")
                ->required()
                ->type_name("A");
            command.add_option("b", options.picture, "picture of the same size (.png .exr)")
                ->required()
                ->type_name("B");
            command.add_option("-o,--out", options.out, "FLIP's error map (.png)")
                ->type_name("FILE");
            command.add_flag("--json", options.json, "print JSON");
        });
    addCommand<LodOptions>(
        line, line.app, "lod",
        "moves the camera away and compares level of detail by distance with full detail", walkLod,
        [](CLI::App& command, LodOptions& options) {
            addSceneOptions(command, options.scene);
            command
                .add_option("--from", options.from, "first distance from /camera/target, m (0.5)")
                ->check(CLI::PositiveNumber);
            command.add_option("--to", options.to, "last distance from /camera/target, m (20)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--steps", options.steps,
                    "number of distances, each by the same factor farther (40)")
                ->check(CLI::Range(2u, 10000u));
            command
                .add_option("-o,--out", options.out, "report file (default results/local/lod.json)")
                ->type_name("FILE");
            command.add_option(
                "--frame", options.frame, "frame whose hair is drawn, from 0 (default 0)");
            command.add_flag(
                "--reference", options.reference,
                "compare levels with the path-traced level 0, lit from 0, 45, 90 and 180 degrees "
                "(needs scripts/setup --reference)");
            command
                .add_option(
                    "--samples", options.samples, "samples per pixel of the reference (default 64)")
                ->check(CLI::Range(1u, 1u << 20));
            command.footer(kLodNotes);
        });
}

// ---- compare, report, convert, merge ------------------------------------------------------------

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const report::Exporter& each : report::exporters()) names.emplace_back(each.name);
    return names;
}

std::string formatNotes() {
    std::string text = "Formats:";
    for (const report::Exporter& each : report::exporters())
        text += "\n  " + std::string(each.name) + ": " + each.description;
    return text;
}

void addCompareOptions(CLI::App& command, report::CompareOptions& options) {
    command.add_option("a", options.a, "report to compare with")->type_name("A");
    command.add_option("b", options.b, "report that may be slower")->type_name("B");
    command
        .add_option(
            "--baseline", options.baseline,
            "report A is the one that run --save-baseline kept under this name")
        ->type_name("NAME");
    command.add_flag("--all", options.all, "list metrics that stayed the same too");
    command.add_flag("--json", options.json, "print JSON");
    addVerdictOptions(command, options.verdict);
}

void addReportCommands(const CommandLine& line) {
    addCommand<report::CompareOptions>(
        line, line.app, "compare", "compares two reports", compareReports, addCompareOptions);
    addCommand<ReportPageOptions>(
        line, line.app, "report", "makes a page of reports (.html) that opens offline",
        writeReportPage, [](CLI::App& command, ReportPageOptions& options) {
            command.add_option("reports", options.reports, "reports; the first is compared with")
                ->required()
                ->type_name("FILE...");
            command.add_option("-o,--out", options.out, "page to write (.html)")
                ->required()
                ->type_name("FILE");
        });
    addCommand<ConvertReportOptions>(
        line, line.app, "convert", "writes a report in the format of another tool", convertReport,
        [](CLI::App& command, ConvertReportOptions& options) {
            command.add_option("report", options.report, "report")->required()->type_name("FILE");
            command
                .add_option("-f,--format", options.format, "format to write, one of the list below")
                ->required()
                ->check(CLI::IsMember(formatNames()));
            command.add_option("-o,--out", options.out, "file to write (default stdout)")
                ->type_name("FILE");
            command.footer(formatNotes());
        });
    addCommand<MergeOptions>(
        line, line.app, "merge", "joins the reports of a sweep's shards", mergeReports,
        [](CLI::App& command, MergeOptions& options) {
            command.add_option("reports", options.reports, "reports of the shards")
                ->required()
                ->type_name("FILE...");
            command.add_option("-o,--out", options.out, "report to write")
                ->required()
                ->type_name("FILE");
            command.add_flag(
                "--force", options.force, "join what is of other scenes, builds, devices");
        });
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app("hairbench: measures simulated and rendered hair on Vulkan devices", "hairbench");
    app.set_version_flag("--version", report::versionText());
    app.require_subcommand(1);
    app.footer(kExamples);

    const std::vector<std::string> arguments(argv, argv + argc);
    Command chosen;
    const CommandLine line{.app = app, .chosen = chosen, .arguments = arguments};
    addMeasuringCommands(line);
    addReportCommands(line);
    addPictureCommands(line);
    addGroomCommands(line);
    addCheckCommands(line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? report::kOk : report::kUsageError;
    }
    engine::catchInterrupts();
    try {
        const measure::ProgressLine progress;
        return chosen();
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted\n";
        return report::kInterrupted;
    }
}

}  // namespace benchmarks::commands
