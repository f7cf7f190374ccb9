#include "benchmarks/commands/command_help.h"
#include "benchmarks/commands/command_line_options.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/memory_need.h"
#include "benchmarks/report/exporters.h"
#include "engine/error.h"

namespace benchmarks::commands {
namespace {

// ---- run, gate, ablate, doctor ------------------------------------------------------------------

constexpr const char* kGateNotes =
    R"(A and B are each a build folder, the prefix that a build is installed to, a program, or a command line.
'run SCENE --out FILE ...' is added to a command line, unless it contains {scene} and {out}. Whole processes
run in the order A B, B A, A B ...; a sample is a process's median. Verdicts are given after 12, 24 and 48
pairs, and after 8 on changes of 20 % in every pair; the gate ends if no metric is inconclusive or one has
regressed. A gate that is stopped prints the last verdicts. Exit status: 0 nothing is slower, 10 something
is slower, 11 inconclusive (--fail-on inconclusive, or out of time before the first verdicts), 12 pictures
or states differ, 130 interrupted before the first verdict.)";

void failOn(const std::string& what, run::RunOptions& options) {
    using report::Trusted;
    if (what == "inconclusive")
        options.verdict.fail_on_inconclusive = true;
    else if (what == "doubtful")
        options.fail_on = Trusted::doubtful;
    else if (!options.fail_on)
        options.fail_on = Trusted::untrusted;
}

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
            "locked: lock the GPU's clocks at a rate that it sustains, if the user may; free: run "
            "only if nobody has locked them; both: run each case both ways (/run/clocks)")
        ->check(CLI::IsMember({"locked", "free", "both"}));
    command.add_flag("--list", options.list, "print the cases' names and stop");
    command.add_flag(
        "--list-passes", options.list_passes,
        "print what the passes of a frame of each case read and write, and their barriers");
    command.add_flag(
        "--dry-run", options.dry_run,
        "list what would run and estimate its time and memory, within seconds");
    command
        .add_option_function<std::string>(
            "--max-memory",
            [&options](const std::string& size) {
                options.max_memory = measure::parseMemorySize(size);
            },
            "skip cases that need more than SIZE (500M, 2G) of device memory or of host memory; on "
            "a software device, of both together")
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
    command.add_flag("--resume", options.resume, "continue an interrupted or killed run");
    command
        .add_option("--shard", options.shard, "run one part of the cases: 2/8 is the second of 8")
        ->type_name("I/N");
    command.add_flag_callback(
        "--no-pictures", [&options] { options.pictures = false; },
        "write no pictures of the cases beside the report");
    command.add_flag_callback(
        "--no-shader-costs", [&options] { options.shader_costs = false; },
        "do not ask the driver's compiler for figures of shaders (see 'shaders'): it may then use "
        "its cache of pipelines");
    command.add_option("--save-baseline", options.save_baseline, "keep the report under this name")
        ->type_name("NAME");
    command
        .add_option(
            "--baseline", options.baseline,
            "compare with the report that --save-baseline kept under this name")
        ->type_name("NAME");
    addVerdictOptions(command, options.verdict);
    command
        .add_option_function<std::vector<std::string>>(
            "--fail-on",
            [&options](const std::vector<std::string>& all) {
                for (const std::string& each : all) failOn(each, options);
            },
            "doubtful, untrusted: exit with 15 where a case's times are no better than that; "
            "inconclusive: with 11 where nothing is slower than the baseline but not all is known")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false)
        ->check(CLI::IsMember({"doubtful", "untrusted", "inconclusive"}));
}

constexpr const char* kShadersNotes =
    R"(Registers, spills, scratch memory, occupancy, instructions, code size and latency of every stage, as the
device's driver tells them (VK_KHR_pipeline_executable_properties): the worst of all cases in the table, each
case in the report. Nothing is timed, so the figures have no noise: 'compare' and 'gate --shaders' judge them.
Drivers of GPUs compile without their GPU, too: docs/devices.md, "Drivers without their GPU". If interrupted,
it tells and saves the cases that are compiled.)";

void addShadersOptions(CLI::App& command, ShadersOptions& options) {
    addSceneOptions(command, options.scene);
    command.add_option("--filter", options.filter, "compile the cases whose name matches")
        ->type_name("REGEX");
    command
        .add_option(
            "-o,--out", options.out, "report file (default results/local/shaders-<scene>.json)")
        ->type_name("FILE");
}

void addGateOptions(CLI::App& command, gate::GateOptions& options) {
    command.add_option("--a", options.a, "build to compare with")
        ->required()
        ->type_name("CMD_OR_BUILD");
    command.add_option("--b", options.b, "build that may be slower")
        ->required()
        ->type_name("CMD_OR_BUILD");
    addScene(command, "--scene", options.scene.scene, "scene file, or the name of a shipped scene")
        ->type_name("SCENE");
    addRepeated(
        command, "--axis", options.scene.axes, "replaces or adds an axis of the sweep (also -a)")
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
    command.add_flag(
        "--shaders", options.shaders,
        "compare what the driver's compiler made of the shaders ('hairbench shaders') instead of "
        "times: one process each, no noise; their reports are left beside --out, as .a.json and "
        ".b.json");
    command
        .add_flag(
            "--probes", options.verdict.probes,
            "compare probes of guides (/run/probes, set for both) instead of times: one process "
            "each, no noise; states and pictures may differ; reports are left as with --shaders")
        ->excludes("--shaders");
    command.add_option("--pairs", options.pairs, "pairs before the first verdict (default 12)")
        ->check(CLI::IsMember({12, 24, 48}));
    command
        .add_option(
            "--calibrate", options.calibration,
            "pairs of A with itself that run first; changes no larger than theirs count as none "
            "(default 0)")
        ->check(CLI::Range(0, 256));
    addVerdictOptions(command, options.verdict);
    addFailOnInconclusive(command, options.verdict);
    command
        .add_option(
            "--smallest-share", options.verdict.smallest_share,
            "passes below this share of their frame do not affect the verdict (default 0.02)")
        ->check(CLI::Range(0.0, 1.0));
    command.add_flag(
        "--all", options.all, "continue after a regression until nothing is inconclusive");
    command
        .add_option(
            "--max-minutes", options.max_minutes,
            "minutes after which no process is started; the last verdicts are printed")
        ->check(CLI::PositiveNumber);
    command.add_option("-o,--out", options.out, "report (default results/local/gate-<scene>.json)")
        ->type_name("FILE");
}

void addAblateOptions(CLI::App& command, AblateOptions& options) {
    addSceneOptions(command, options.scene);
    addSamplingOptions(command, options.scene);
    command.add_option("--filter", options.filter, "run the cases whose name matches")
        ->type_name("REGEX");
    command
        .add_option(
            "--passes", options.passes, "passes up and down the ladder of stages (default 8)")
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
            "pairs of equal processes to estimate the smallest slowdown that a gate can find here "
            "(48 for a firm answer; default 0: no estimate)")
        ->check(CLI::Range(0, 256));
    command.add_flag(
        "--planted", options.planted,
        "plant slowdowns of 1.5 times that estimate in one pass and report whether a gate finds "
        "them; takes long");
    command.add_option("-o,--out", options.out, "file for the findings (JSON)")->type_name("FILE");
    command
        .add_option(
            "--rules", options.rules,
            "check a report against the twelve rules of Hoefler and Belli (SC 2015) instead of "
            "examining the machine")
        ->type_name("REPORT")
        ->excludes("--pairs")
        ->excludes("--planted")
        ->excludes("--out");
    command
        .add_option(
            "--reports", options.reports,
            "check instead whether reports may be kept: they must match their schema, and be "
            "trustworthy or marked as not to be trusted")
        ->type_name("REPORT...")
        ->excludes("--pairs")
        ->excludes("--planted")
        ->excludes("--out")
        ->excludes("--rules");
}

}  // namespace

void addMeasuringCommands(const CommandLine& line) {
    addCommand<run::RunOptions>(
        line, line.app,
        {.name = "run",
         .description = "plays a scene's or a suite's cases and writes a report",
         .examples =
             {"hairbench run scenes/thesis.json -a /strands/density=16,32,64 -a /render/msaa=1,4",
              "hairbench run thesis --filter 'guides:86/.*msaa:1' --out "
              "results/mine.json",
              "hairbench run full --resume", "hairbench run thesis --dry-run",
              "hairbench run rest --list-passes"}},
        runScene, addRunOptions);
    addCommand<gate::GateOptions>(
        line, line.app,
        {.name = "gate",
         .description = "decides whether build B is slower than build A",
         .examples =
             {"hairbench gate --a build/old --b build/new --scene smoke",
              "hairbench gate --a build/new --b build/new --scene smoke --set-b "
              "/strands/density=32"},
         .notes = kGateNotes},
        gateBuilds, addGateOptions);
    addCommand<ShadersOptions>(
        line, line.app,
        {.name = "shaders",
         .description = "tells what the driver's compiler made of a scene's shaders",
         .examples =
             {"hairbench shaders backends",
              "hairbench shaders thesis --filter 'msaa:1' -o shaders.json"},
         .notes = kShadersNotes},
        compileShaders, addShadersOptions);
    addCommand<AblateOptions>(
        line, line.app,
        {.name = "ablate",
         .description = "measures the cost of each stage of the strands, from frames without it",
         .examples = {"hairbench ablate rest"}},
        ablateScene, addAblateOptions);
    addCommand<DoctorOptions>(
        line, line.app,
        {.name = "doctor",
         .description = "checks whether timings of this machine can be trusted, and says why",
         .examples =
             {"hairbench doctor", "hairbench doctor --pairs 48 -o doctor.json",
              "hairbench doctor --rules results/mine.json",
              "hairbench doctor --reports results/*.json"}},
        examineMachine, addDoctorOptions);
}

// ---- compare, report, convert, merge ------------------------------------------------------------

namespace {

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
            "take the report that 'run --save-baseline' kept under this name as A")
        ->type_name("NAME");
    command.add_flag("--all", options.all, "also list metrics that stayed the same");
    command.add_flag(
        "--probes", options.verdict.probes,
        "compare probes of guides (/run/probes) instead of times; states and pictures may differ");
    command.add_flag("--json", options.json, "print JSON");
    addVerdictOptions(command, options.verdict);
    addFailOnInconclusive(command, options.verdict);
}

}  // namespace

void addReportCommands(const CommandLine& line) {
    addCommand<report::CompareOptions>(
        line, line.app,
        {.name = "compare",
         .description = "compares two reports",
         .examples =
             {"hairbench compare old.json new.json",
              "hairbench compare --baseline main new.json --threshold 3%"}},
        compareReports, addCompareOptions);
    addCommand<ReportPageOptions>(
        line, line.app,
        {.name = "report",
         .description = "makes a page of reports (.html) that opens offline",
         .examples =
             {"hairbench report results/mine.json -o mine.html",
              "hairbench report old.json new.json -o both.html",
              "hairbench report results/*.json -o index.html"}},
        writeReportPage, [](CLI::App& command, ReportPageOptions& options) {
            command
                .add_option(
                    "reports", options.reports,
                    "reports of any devices and scenes; each is compared with the first of "
                    "its scene")
                ->required()
                ->type_name("FILE...");
            command.add_option("-o,--out", options.out, "page to write (.html)")
                ->required()
                ->type_name("FILE");
        });
    addCommand<ConvertReportOptions>(
        line, line.app,
        {.name = "convert",
         .description = "writes a report in the format of another tool",
         .examples = {"hairbench convert results/mine.json -f csv -o mine.csv"},
         .notes = formatNotes()},
        convertReport, [](CLI::App& command, ConvertReportOptions& options) {
            command.add_option("report", options.report, "report")->required()->type_name("FILE");
            command
                .add_option("-f,--format", options.format, "format to write, one of the list below")
                ->required()
                ->check(CLI::IsMember(formatNames()));
            command.add_option("-o,--out", options.out, "file to write (default stdout)")
                ->type_name("FILE");
        });
    addCommand<MergeOptions>(
        line, line.app,
        {.name = "merge",
         .description = "joins the reports of a sweep's shards",
         .examples = {"hairbench merge part*.json -o whole.json"}},
        mergeReports, [](CLI::App& command, MergeOptions& options) {
            command.add_option("reports", options.reports, "reports of the shards")
                ->required()
                ->type_name("FILE...");
            command.add_option("-o,--out", options.out, "report to write")
                ->required()
                ->type_name("FILE");
            command.add_flag(
                "--force", options.force,
                "join reports even if their scenes, builds or devices differ");
        });
}

// ---- physics, validate, schema, devices ---------------------------------------------------------

void addCheckCommands(const CommandLine& line) {
    addCommand<PhysicsOptions>(
        line, line.app,
        {.name = "physics",
         .description = "checks the solvers against theory and writes a report",
         .examples =
             {"hairbench physics", "hairbench physics --solver rod --check 'cantilever|catenary'",
              "hairbench physics --invariance", "hairbench physics --work-precision"}},
        checkPhysics, [](CLI::App& command, PhysicsOptions& options) {
            addRepeated(
                command, "--solver", options.solvers,
                "solver to check, or a file of GLSL with one; repeatable (default all of the "
                "program's)")
                ->type_name("NAME|FILE");
            CLI::Option* const check =
                command.add_option("--check", options.check, "run the checks whose name matches")
                    ->type_name("REGEX");
            CLI::Option* const invariance =
                command
                    .add_flag(
                        "--invariance", options.invariance,
                        "print how far hair is from that of the finest step, substep, mesh and "
                        "number of iterations, at rest and in motion")
                    ->excludes(check);
            command
                .add_flag(
                    "--work-precision", options.work_precision,
                    "measure error and time of each solver over substeps and iterations, and "
                    "recommend a solver for a given error")
                ->excludes(check)
                ->excludes(invariance);
            command
                .add_flag(
                    "--papers", options.papers,
                    "play the published results of scenes/papers beside their figures instead of "
                    "the checks")
                ->excludes(check)
                ->excludes(invariance)
                ->excludes("--work-precision")
                ->excludes("--solver");
            command
                .add_option(
                    "--out", options.out, "report file (default results/local/physics.json)")
                ->type_name("FILE");
            addDeviceOptions(command, options.device);
        });

    addCommand<ValidateOptions>(
        line, line.app,
        {.name = "validate",
         .description = "checks scene files and their assets",
         .examples = {"hairbench validate scenes/*.json", "hairbench validate mine.json --start"}},
        validateScenes, [](CLI::App& command, ValidateOptions& options) {
            addScene(command, "scenes", options.scenes, "scene files, or names of shipped scenes")
                ->type_name("SCENE...");
            addOutsideOption(command, options.outside);
            command.add_flag(
                "--start", options.start,
                "settle each scene's hair on the device, without its sweep, and report faults: "
                "stretched, inside a body, still moving, not balanced");
            command
                .add_flag(
                    "--strict", options.strict,
                    "with --start: refuse files of hair with strands that can't be used, which are "
                    "left out otherwise")
                ->needs("--start");
            command.add_option(
                "--device", options.device.wanted,
                "for --start: index or part of the name of the device");
        });
    addCommand<SchemaOptions>(
        line, line.app,
        {.name = "schema",
         .description = "prints the JSON Schema of scene files",
         .examples =
             {"hairbench schema > scene.schema.json", "hairbench schema --markdown scenes"}},
        printSchema, [](CLI::App& command, SchemaOptions& options) {
            command
                .add_option(
                    "--markdown", options.examples,
                    "print a Markdown page of every field instead, with examples from the scenes "
                    "of FOLDER")
                ->type_name("FOLDER");
        });
    addCommand(
        line, line.app,
        {.name = "devices",
         .description = "lists the Vulkan devices and the features that they lack",
         .examples = {"hairbench devices"}},
        printDevices);
}

// ---- scenes, completion, man --------------------------------------------------------------------

void addProgramCommands(const CommandLine& line) {
    addCommand<ScenesOptions>(
        line, line.app,
        {.name = "scenes",
         .description = "lists the scenes that come with the program and their purposes",
         .examples = {"hairbench scenes"}},
        printScenes, [](CLI::App& command, ScenesOptions& options) {
            command.add_flag("--names", options.names, "print only their names");
        });
    addCommand<NewOptions>(
        line, line.app,
        {.name = "new",
         .description = "makes a folder for a scene of one's own, based on a shipped scene",
         .examples =
             {"hairbench new my_hair --from wavy_bob",
              "hairbench new braids --from portraits/braid"}},
        makeScene, [](CLI::App& command, NewOptions& options) {
            command.add_option("folder", options.folder, "folder to make; the scene gets its name")
                ->required()
                ->type_name("FOLDER");
            command
                .add_option(
                    "--from", options.from,
                    "name of the shipped scene whose values it changes (default thesis)")
                ->type_name("SCENE");
        });
    addCommand<CompletionOptions>(
        line, line.app,
        {.name = "completion",
         .description = "prints the completion script of a shell",
         .examples = {"hairbench completion bash >> ~/.bash_completion"}},
        printCompletion, [](CLI::App& command, CompletionOptions& options) {
            command.add_option("shell", options.shell, "name of the shell")
                ->required()
                ->type_name("SHELL")
                ->check(CLI::IsMember(shellNames()));
        });
    addCommand<ManualOptions>(
        line, line.app,
        {.name = "man",
         .description = "prints the manual page of the program or of a command",
         .examples = {"hairbench man run | man -l -", "hairbench man --out man1"}},
        printManual, [](CLI::App& command, ManualOptions& options) {
            command.add_option("command", options.words, "the command's words: groom info")
                ->type_name("COMMAND...");
            command
                .add_option(
                    "-o,--out", options.out, "folder for this page and those of its subcommands")
                ->type_name("FOLDER");
        });
}

}  // namespace benchmarks::commands
