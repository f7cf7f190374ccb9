#include <iostream>

#include <CLI/CLI.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/environment.h"
#include "benchmarks/exit_codes.h"
#include "engine/instance.h"

namespace {

using namespace benchmarks;

constexpr const char* kExamples = R"(Examples:
  hairbench run scenes/thesis.json -a /strands/density=16,32,64 -a /render/msaa=1,4
  hairbench run scenes/thesis.json --filter 'guides:86/.*msaa:1' --out results/mine.json
  hairbench render scenes/strong_wind.json -o wind.png --frame 60
  hairbench render scenes/strong_wind.json -o out/%04d.png --frames 0:240
  hairbench validate scenes/*.json
  hairbench groom info hair.hair --mesh head.glb
  hairbench groom convert hair.hair guides.hgl --guides 200 --vertices 16 --scale 0.01
  hairbench simulate scenes/nod.json --frames 60 --export nod.usda
  hairbench reference scenes/strong_wind.json -o truth.exr --samples 256
  hairbench diff truth.exr picture.png -o difference.png
  hairbench lod scenes/rest.json --from 0.5 --to 20 --steps 40 -o lod.json
  hairbench physics --solver rod --check 'cantilever|catenary'
Exit status: 0 ok, 1 internal error, 2 usage or invalid scene, 3 a check of the physics
failed, 14 nothing ran, 77 no suitable device, 130 interrupted (what was done is saved).)";

constexpr const char* kConvertNotes = R"(Done in this order: scale, followers, vertices, guides.
Without --scale lengths stay as they are, but that .hgl is always in metres: what IN states of its
unit is applied. .hgl gets root triangles if IN has none. What a format can't hold is said on
stderr. OUT may be IN; it is replaced when all is written, and an interrupt leaves it alone.)";

constexpr const char* kLodNotes =
    R"(The hair of one frame stands still; the camera keeps its direction. Error: root mean square of
the picture with /lod's levels less that of level 0, display values counting from 0 to 1. Popping:
the same of what changes from one place to the next, less what changes at level 0. Coverage: share
of a square round the hair that it hides, without the head. Times: medians of isolated frames.)";

void addDeviceOptions(CLI::App& command, engine::DeviceOptions& options) {
    command.add_option(
        "--device", options.wanted,
        "index or part of the name of the device (see 'hairbench devices')");
    command.add_flag_callback(
        "--validate", [&options] { options.validation = engine::Validation::on; },
        "run under the Vulkan validation layer; slow");
}

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, "scene file (.json)")->required()->type_name("FILE");
    command
        .add_option(
            "-a,--axis", options.axes,
            "replaces or adds an axis of the sweep: /strands/density=16,32")
        ->type_name("POINTER=V1,V2")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    addDeviceOptions(command, options.device);
}

CLI::App* addRun(CLI::App& app, RunOptions& options) {
    CLI::App* command = app.add_subcommand("run", "plays a scene's cases and writes a report");
    addSceneOptions(*command, options.scene);
    command->add_option("--frames", options.scene.frames, "measured frames per case and mode");
    command->add_option("--warmup", options.scene.warmup, "frames drawn before measuring");
    command->add_option("--filter", options.filter, "run the cases whose name matches")
        ->type_name("REGEX");
    command->add_option("--out", options.out, "report file (default results/local/<scene>.json)")
        ->type_name("FILE");
    command->add_flag("--dry-run", options.dry_run, "list the cases and stop");
    return command;
}

CLI::App* addRender(CLI::App& app, RenderOptions& options) {
    CLI::App* command = app.add_subcommand("render", "writes pictures of one frame or several");
    addSceneOptions(*command, options.scene);
    command
        ->add_option(
            "-o,--out", options.out,
            "picture: .png as a display shows it, .exr linear light without exposure and tone map; "
            "of several frames with their number in it, as in out/%04d.png")
        ->required()
        ->type_name("FILE");
    CLI::Option* frame =
        command->add_option("--frame", options.frame, "frame to draw, from 0 (default 0)")
            ->check(CLI::Range(0, 1'000'000));
    command
        ->add_option(
            "--frames", options.frames, "frames to draw: A, A+1 ... below B, or every STEPth")
        ->type_name("A:B[:STEP]")
        ->excludes(frame);
    return command;
}

CLI::App* addSimulate(CLI::App& app, SimulateOptions& options) {
    CLI::App* command =
        app.add_subcommand("simulate", "plays a scene and writes its strands, without a picture");
    addSceneOptions(*command, options.scene);
    command->add_option("--frames", options.frames, "frames to play (default 60)")
        ->check(CLI::PositiveNumber);
    command
        ->add_option(
            "--export", options.out,
            "file; .usda holds every frame, other formats (see 'groom convert') the last")
        ->required()
        ->type_name("FILE");
    command->add_flag("--guides", options.guides, "the guides instead of the drawn strands");
    return command;
}

CLI::App* addExport(CLI::App& app, ExportOptions& options) {
    CLI::App* command =
        app.add_subcommand("export", "writes one frame as a scene of another renderer");
    addSceneOptions(*command, options.scene);
    command->add_option("--mitsuba", options.mitsuba, "folder for a Mitsuba 3 scene (scene.xml)")
        ->required()
        ->type_name("DIR");
    command->add_option("--frame", options.frame, "frame to write, from 0 (default 0)");
    return command;
}

CLI::App* addReference(CLI::App& app, ReferenceOptions& options) {
    CLI::App* command = app.add_subcommand(
        "reference", "path-traces one frame with Mitsuba 3 (scripts/setup --reference)");
    addSceneOptions(*command, options.scene);
    command->add_option("-o,--out", options.out, "picture (.exr linear, .png sRGB)")
        ->required()
        ->type_name("FILE");
    command->add_option("--samples", options.samples, "samples per pixel (default 64)")
        ->check(CLI::Range(1, 1'000'000));
    command->add_option("--frame", options.frame, "frame to draw, from 0 (default 0)");
    return command;
}

CLI::App* addDiff(CLI::App& app, DiffOptions& options) {
    CLI::App* command = app.add_subcommand(
        "diff", "compares pictures: RMSE, PSNR, SSIM, FLIP (scripts/setup --reference)");
    command->add_option("a", options.reference, "reference (.png .exr)")
        ->required()
        ->type_name("A");
    command->add_option("b", options.picture, "picture of the same size (.png .exr)")
        ->required()
        ->type_name("B");
    command->add_option("-o,--out", options.out, "FLIP's error map (.png)")->type_name("FILE");
    command->add_flag("--json", options.json, "as JSON");
    return command;
}

CLI::App* addLod(CLI::App& app, LodOptions& options) {
    CLI::App* command = app.add_subcommand(
        "lod", "moves the camera away and compares level of detail by distance with full detail");
    addSceneOptions(*command, options.scene);
    command->add_option("--from", options.from, "first distance from /camera/target, m (0.5)")
        ->check(CLI::PositiveNumber);
    command->add_option("--to", options.to, "last distance, m (20)")->check(CLI::PositiveNumber);
    command->add_option("--steps", options.steps, "places, each as many times farther (40)")
        ->check(CLI::Range(2u, 10000u));
    command->add_option("-o,--out", options.out, "report file (default results/local/lod.json)")
        ->type_name("FILE");
    command->add_option("--frame", options.frame, "frame whose hair is drawn, from 0 (default 0)");
    command->footer(kLodNotes);
    return command;
}

struct GroomCommands {
    CLI::App* info;
    CLI::App* convert;
};

GroomCommands addGroom(CLI::App& app, GroomInfoOptions& info, GroomConvertOptions& convert) {
    CLI::App* groom = app.add_subcommand("groom", "inspects and converts files of hair");
    groom->require_subcommand(1);

    CLI::App* info_command =
        groom->add_subcommand("info", "says what is in a file of hair and what is odd about it");
    info_command->add_option("file", info.file, "file of hair")->required()->type_name("FILE");
    info_command->add_option("--mesh", info.mesh, "what the hair grows on: are the roots on it?")
        ->type_name("FILE");
    info_command
        ->add_option("--scale", info.scale, "metres in the file's unit (default stated or guessed)")
        ->check(CLI::PositiveNumber);
    info_command->add_flag("--json", info.json, "as JSON");

    CLI::App* convert_command = groom->add_subcommand(
        "convert", "rewrites a file of hair: .hair .hgl .tfx .obj .ply .gltf .glb .usda");
    convert_command->add_option("in", convert.in, "file of hair")->required()->type_name("IN");
    convert_command->add_option("out", convert.out, "file to write")->required()->type_name("OUT");
    convert_command
        ->add_option(
            "--scale", convert.scale, "metres in IN's unit (0.01: centimetres); OUT is in metres")
        ->check(CLI::PositiveNumber);
    convert_command->add_option(
        "--followers", convert.followers,
        "so many copies round each strand, as TressFX makes them");
    convert_command
        ->add_option(
            "--follower-radius", convert.follower_radius,
            "radius of the disc that they are in, in IN's unit")
        ->check(CLI::NonNegativeNumber);
    convert_command
        ->add_option(
            "--tip-separation", convert.tip_separation,
            "factor of their displacement at the tip (default 1)")
        ->check(CLI::NonNegativeNumber);
    convert_command->add_option(
        "--vertices", convert.vertices, "points per strand, even by arc length (2 to 65536)");
    convert_command
        ->add_option(
            "--guides", convert.guides, "keep so many strands, spread over roots and shapes")
        ->check(CLI::PositiveNumber);
    convert_command
        ->add_option(
            "--mesh", convert.mesh,
            "what the hair grows on, in metres: for the root triangles of OUT.hgl")
        ->type_name("FILE");
    convert_command->add_option(
        "--seed", convert.seed, "of followers and of the choice of guides (default 1)");
    convert_command->footer(kConvertNotes);
    return {info_command, convert_command};
}

CLI::App* addPhysics(CLI::App& app, PhysicsOptions& options) {
    CLI::App* command =
        app.add_subcommand("physics", "holds the solvers against theory and writes a report");
    command->add_option("--solver", options.solvers, "solver to check; repeatable (default all)")
        ->type_name("NAME")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command->add_option("--check", options.check, "run the checks whose name matches")
        ->type_name("REGEX");
    command->add_option("--out", options.out, "report file (default results/local/physics.json)")
        ->type_name("FILE");
    addDeviceOptions(*command, options.device);
    return command;
}

int dispatch(int argc, char** argv) {
    CLI::App app("hairbench: measures simulated and rendered hair on Vulkan devices", "hairbench");
    app.set_version_flag("--version", versionText());
    app.require_subcommand(1);
    app.footer(kExamples);

    RunOptions run;
    run.command.assign(argv, argv + argc);
    RenderOptions render;
    LodOptions lod;
    lod.command = run.command;
    PhysicsOptions physics;
    SimulateOptions simulate;
    ExportOptions exported;
    ReferenceOptions reference;
    DiffOptions diff;
    GroomInfoOptions groom_info;
    GroomConvertOptions groom_convert;
    physics.command = run.command;
    std::vector<std::filesystem::path> scenes;
    const CLI::App* run_command = addRun(app, run);
    const CLI::App* render_command = addRender(app, render);
    const CLI::App* lod_command = addLod(app, lod);
    const CLI::App* physics_command = addPhysics(app, physics);
    const CLI::App* simulate_command = addSimulate(app, simulate);
    const CLI::App* export_command = addExport(app, exported);
    const CLI::App* reference_command = addReference(app, reference);
    const CLI::App* diff_command = addDiff(app, diff);
    const GroomCommands groom = addGroom(app, groom_info, groom_convert);
    CLI::App* validate_command =
        app.add_subcommand("validate", "checks scene files and their assets");
    validate_command->add_option("scenes", scenes, "scene files")->required()->type_name("FILE...");
    const CLI::App* schema_command =
        app.add_subcommand("schema", "prints the JSON Schema of scene files");
    app.add_subcommand("devices", "lists the Vulkan devices and what they lack");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? kOk : kUsageError;
    }
    if (run_command->parsed()) return runScene(run);
    if (render_command->parsed()) return renderScene(render);
    if (lod_command->parsed()) return walkLod(lod);
    if (physics_command->parsed()) return checkPhysics(physics);
    if (simulate_command->parsed()) return simulateScene(simulate);
    if (export_command->parsed()) return exportScene(exported);
    if (reference_command->parsed()) return renderReference(reference);
    if (diff_command->parsed()) return diffPictures(diff);
    if (groom.info->parsed()) return inspectGroom(groom_info);
    if (groom.convert->parsed()) return convertGroom(groom_convert);
    if (validate_command->parsed()) return validateScenes(scenes);
    if (schema_command->parsed()) return printSchema();
    return printDevices();
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return dispatch(argc, argv);
    } catch (const engine::NoDevice& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return kNoDevice;
    } catch (const engine::Error& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return kUsageError;
    } catch (const std::exception& error) {
        std::cerr << "hairbench: internal error: " << error.what() << '\n';
        return kInternalError;
    }
}
