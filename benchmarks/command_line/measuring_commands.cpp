#include "benchmarks/command_line/command_line.h"

namespace benchmarks {

namespace {

constexpr const char* kGateNotes =
    R"(A and B are a build folder, a program, or a command line that 'run SCENE --out FILE ...' is added to;
one with {scene} and {out} in it is taken as it is. Whole processes run as A B, B A, A B ...; a sample
is a process's median. After 12, 24 and 48 pairs it is over if no metric is inconclusive. Exit status:
0 nothing is slower, 10 something is, 11 inconclusive (--fail-on inconclusive), 12 pictures or states
differ.)";

void addRunOptions(CLI::App& command, RunOptions& options) {
    addSceneOptions(command, options.scene);
    addSamplingOptions(command, options.scene);
    command.add_option("--filter", options.filter, "run the cases whose name matches")
        ->type_name("REGEX");
    command.add_option("-o,--out", options.out, "report file (default results/local/<scene>.json)")
        ->type_name("FILE");
    command.add_flag("--list", options.list, "print the cases' names and stop");
    command.add_flag("--dry-run", options.dry_run, "say what would run, estimate memory and time");
    command.add_option(
        "--order-seed", options.order_seed, "of the order of the cases (default: a random one)");
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
            "--baseline", options.baseline, "compare with the report of that name; see compare")
        ->type_name("NAME");
    addVerdictOptions(command, options.verdict);
}

void addGateOptions(CLI::App& command, GateOptions& options) {
    command.add_option("--a", options.a, "what to compare with")
        ->required()
        ->type_name("CMD_OR_BUILD");
    command.add_option("--b", options.b, "what may be slower")
        ->required()
        ->type_name("CMD_OR_BUILD");
    command.add_option("--scene", options.scene.scene, "scene file")->required()->type_name("FILE");
    // No -a beside --a: newer CLI11 takes them for one name.
    addRepeated(command, "--axis", options.scene.axes, "as for run")->type_name("POINTER=V1,V2");
    addRepeated(command, "--set", options.scene.sets, "as for run")->type_name("POINTER=VALUE");
    addRepeated(command, "--set-a", options.a_sets, "the same for A alone")
        ->type_name("POINTER=VALUE");
    addRepeated(command, "--set-b", options.b_sets, "the same for B alone")
        ->type_name("POINTER=VALUE");
    addSamplingOptions(command, options.scene);
    command.add_option("--device", options.scene.device.wanted, "as for run");
    command.add_option("--filter", options.filter, "the cases whose name matches")
        ->type_name("REGEX");
    command.add_option("--pairs", options.pairs, "pairs before the first verdict (default 12)")
        ->check(CLI::IsMember({12, 24, 48}));
    command
        .add_option(
            "--calibrate", options.calibration,
            "pairs of A with itself first: changes that A has by itself count as none (default 0)")
        ->check(CLI::Range(0, 256));
    addVerdictOptions(command, options.verdict);
    command.add_option("-o,--out", options.out, "report (default results/local/gate-<scene>.json)")
        ->type_name("FILE");
    command.footer(kGateNotes);
}

void addAblateOptions(CLI::App& command, AblateOptions& options) {
    addSceneOptions(command, options.scene);
    addSamplingOptions(command, options.scene);
    command.add_option("--filter", options.filter, "the cases whose name matches")
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
            "pairs of processes to find the smallest slowdown that a gate can find here with "
            "(48 for a firm answer; default 0: don't)")
        ->check(CLI::Range(0, 256));
    command.add_flag(
        "--planted", options.planted,
        "and whether slowdowns of 1.5 times that, planted in one pass, are found; takes long");
    command.add_option("-o,--out", options.out, "findings as JSON")->type_name("FILE");
}

}  // namespace

void addMeasuringCommands(const CommandLine& line) {
    addCommand<RunOptions>(
        line, line.app, "run", "plays a scene's or a suite's cases and writes a report", runScene,
        addRunOptions);
    addCommand<GateOptions>(
        line, line.app, "gate", "decides whether build B is slower than build A", gateBuilds,
        addGateOptions);
    addCommand<AblateOptions>(
        line, line.app, "ablate", "what each stage of the strands costs: the frame without it",
        ablateScene, addAblateOptions);
    addCommand<DoctorOptions>(
        line, line.app, "doctor", "says whether timings of this machine can be trusted, and why",
        examineMachine, addDoctorOptions);
}

}  // namespace benchmarks
