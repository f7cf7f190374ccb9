#include "benchmarks/commands/command_line_options.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/system/files.h"

namespace benchmarks::commands {
namespace {

constexpr const char* kLodNotes =
    R"(The hair of one frame stands still; the camera keeps its direction. Error: root mean square of the
difference between the pictures with /lod's levels and at level 0, in display values from 0 to 1.
FLIP: the mean error by FLIP between the same pictures.
Popping: root mean square of the change from one distance to the next, minus the change at level 0.
Coverage: share of a square round the hair that the hair covers, without the head. Times: medians of
isolated frames. With --reference, whole levels are compared with the path-traced level 0, lit by one
directional light at each angle from the camera; popping is the change over the last 0.05 of the level.)";

constexpr const char* kShimmerNotes =
    R"(The hair of one frame stands still; the camera turns about its target and up vector. The truth has 64
samples per pixel and sampled coverage. All figures are means over the views, the pixels and the
colours, in thousandths of the display's range. Shimmer: the magnitude of the change from one view to
the next, minus the truth's change. Change: the magnitude of the truth's change. Error: the magnitude
of the difference from the truth. Cases that differ in their sampling alone share the truth.)";

void addSweepOptions(CLI::App& command, SweepOptions& options) {
    addSceneOptions(command, options.scene);
    command
        .add_option("--filter", options.filter, "with {case}: play the cases whose name matches")
        ->type_name("REGEX");
    command
        .add_option(
            "--shard", options.shard,
            "with {case}: play one part of the cases: 2/8 is the second of 8")
        ->type_name("I/N");
    command.add_flag(
        "--resume", options.resume,
        "with {case}: play only the cases that an interrupted or killed sweep left");
    command.add_flag("--json", options.json, "print what was written as JSON");
}

}  // namespace

void addPictureCommands(const CommandLine& line) {
    addCommand<viewer::ViewOptions>(
        line, line.app,
        {.name = "view",
         .description = "opens a scene in a window",
         .examples =
             {"hairbench view wavy_bob",
              "hairbench view scenes/strong_wind.json --width 1920 --height 1080"}},
        viewScene, [](CLI::App& command, viewer::ViewOptions& options) {
            options.program = engine::system::thisProgram();
            addSceneOptions(command, options.scene);
            command.add_option("--width", options.width, "width of the window (default 1600)");
            command.add_option("--height", options.height, "height of the window (default 900)");
            command.add_option(
                "--scale", options.scale, "scale of text and widgets (default: the screen's)");
            command.add_option(
                "--frames", options.frames,
                "frames that the window draws before it closes (default: it stays open)");
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
                    "folder whose GLSL is watched and reloaded (default: the program's own)")
                ->type_name("FOLDER");
            command
                .add_option(
                    "--preferences", options.preferences,
                    "file that remembers layout and theme (default: the user's own; with --script "
                    "none)")
                ->type_name("FILE");
        });
    addCommand<RenderOptions>(
        line, line.app,
        {.name = "render",
         .description = "writes pictures of one frame or several",
         .examples =
             {"hairbench render strong_wind -o wind.png --frame 60",
              "hairbench render strong_wind -o out/%04d.png --frames 0:240",
              "hairbench render smoke -o 'out/{case}.png' -a /simulation/wind/strength=0,5"}},
        renderScene, [](CLI::App& command, RenderOptions& options) {
            addSweepOptions(command, options.sweep);
            command
                .add_option(
                    "-o,--out", options.out,
                    "picture to write: .png as a display shows it, .exr with linear radiance, "
                    "before exposure and tone mapping, or .npy (NumPy's, uint8 [row, column, "
                    "RGBA]); for several frames a name with their number, as in out/%04d.png; with "
                    "{case} in its name, all cases of the sweep are drawn, each into its file")
                ->required()
                ->type_name("FILE");
            command.add_flag(
                "--linear", options.linear,
                "write .npy as float32 [row, column, RGB]: linear radiance, as in .exr");
            CLI::Option* frame =
                command.add_option("--frame", options.frame, "frame to draw, from 0 (default 0)")
                    ->check(CLI::Range(0, 1'000'000));
            command
                .add_option(
                    "--frames", options.frames,
                    "frames to draw: A, A+1 ... B-1, or every STEPth of them")
                ->type_name("A:B[:STEP]")
                ->excludes(frame);
        });
    addCommand<SimulateOptions>(
        line, line.app,
        {.name = "simulate",
         .description = "plays a scene and writes its strands, without a picture",
         .examples =
             {"hairbench simulate nod --frames 60 --export nod.usda",
              "hairbench simulate smoke --guides --export 'sim_{case}.npy' -a "
              "/simulation/wind/strength=0,5"}},
        simulateScene, [](CLI::App& command, SimulateOptions& options) {
            addSweepOptions(command, options.sweep);
            command.add_option("--frames", options.recording.frames, "frames to play (default 60)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--export", options.recording.out,
                    "file to write; .usda, .usdc, .abc, .npy (NumPy's, float32 [frame, strand, "
                    "point, 3], m) and .npz (positions, times, metadata) hold every frame, other "
                    "formats (see 'groom convert') the last; with {case} in its name, all cases of "
                    "the sweep "
                    "are played, each into its file")
                ->type_name("FILE");
            command
                .add_option(
                    "--probes", options.probes,
                    "table (.csv) of the scene's /run/probes to write, with a row for each frame "
                    "of all cases of the sweep")
                ->type_name("FILE");
            command.add_flag(
                "--guides", options.recording.guides,
                "write the guides instead of the drawn strands");
        });
    addCommand<ExportOptions>(
        line, line.app,
        {.name = "export",
         .description = "writes one frame as a scene of another renderer",
         .examples = {"hairbench export rest --mitsuba rest"}},
        exportScene, [](CLI::App& command, ExportOptions& options) {
            addSceneOptions(command, options.scene);
            command
                .add_option(
                    "--mitsuba", options.mitsuba, "folder for a Mitsuba 3 scene (scene.xml)")
                ->required()
                ->type_name("DIR");
            command.add_option("--frame", options.frame, "frame to write, from 0 (default 0)");
        });
    addCommand<ReferenceOptions>(
        line, line.app,
        {.name = "reference",
         .description =
             "path-traces one frame with Mitsuba 3, in the Python environment 'reference'",
         .examples = {"hairbench reference strong_wind -o truth.exr --samples 256"}},
        renderReference, [](CLI::App& command, ReferenceOptions& options) {
            addSceneOptions(command, options.scene);
            command.add_option("-o,--out", options.out, "picture (.exr linear, .png sRGB)")
                ->required()
                ->type_name("FILE");
            command.add_option("--samples", options.samples, "samples per pixel (default 64)")
                ->check(CLI::Range(1, 1'000'000));
            command.add_option("--frame", options.frame, "frame to draw, from 0 (default 0)");
        });
    addCommand<DiffOptions>(
        line, line.app,
        {.name = "diff",
         .description =
             "compares pictures: RMSE, PSNR, SSIM, FLIP; in the Python environment 'reference'",
         .examples = {"hairbench diff truth.exr picture.png -o difference.png"}},
        diffPictures, [](CLI::App& command, DiffOptions& options) {
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
        line, line.app,
        {.name = "lod",
         .description = "moves the camera away and compares levels of detail with full detail",
         .examples = {"hairbench lod rest --from 0.5 --to 20 --steps 40 -o lod.json"},
         .notes = kLodNotes},
        walkLod, [](CLI::App& command, LodOptions& options) {
            addSceneOptions(command, options.scene);
            command
                .add_option(
                    "--from", options.from, "first distance from /camera/target, m (default 0.5)")
                ->check(CLI::PositiveNumber);
            command
                .add_option("--to", options.to, "last distance from /camera/target, m (default 20)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--steps", options.steps,
                    "number of distances, each farther by the same factor (default 40)")
                ->check(CLI::Range(2u, 10000u));
            command
                .add_option("-o,--out", options.out, "report file (default results/local/lod.json)")
                ->type_name("FILE");
            command.add_option(
                "--frame", options.frame, "frame whose hair is drawn, from 0 (default 0)");
            command.add_flag(
                "--clusters", options.clusters,
                "compare levels by cluster, with the scene's /lod/error, as well");
            command.add_flag(
                "--reference", options.reference,
                "compare levels with the path-traced level 0, lit from 0, 45, 90 and 180 degrees "
                "(in the Python environment 'reference')");
            command
                .add_option(
                    "--samples", options.samples, "samples per pixel of the reference (default 64)")
                ->check(CLI::Range(1u, 1u << 20));
        });
    addCommand<ShimmerOptions>(
        line, line.app,
        {.name = "shimmer",
         .description = "turns the camera and measures how much still hair shimmers",
         .examples =
             {"hairbench shimmer portraits/layers -a /render/msaa=1,4",
              "hairbench shimmer msaa --turn 6 --steps 12 --json"},
         .notes = kShimmerNotes},
        measureShimmer, [](CLI::App& command, ShimmerOptions& options) {
            addSceneOptions(command, options.scene);
            command.add_option("--filter", options.filter, "draw the cases whose name matches")
                ->type_name("REGEX");
            command
                .add_option("--turn", options.turn, "angle of the whole turn, degrees (default 12)")
                ->check(CLI::Range(-360.0, 360.0));
            command.add_option("--steps", options.steps, "number of equal steps (default 24)")
                ->check(CLI::Range(1u, 10000u));
            command.add_option(
                "--frame", options.frame, "frame whose hair is drawn, from 0 (default 0)");
            command.add_flag("--json", options.json, "print JSON");
        });
}

}  // namespace benchmarks::commands
