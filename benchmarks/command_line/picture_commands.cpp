#include "benchmarks/command_line/command_line.h"
#include "benchmarks/viewer/viewer.h"

namespace benchmarks {

namespace {

constexpr const char* kLodNotes =
    R"(The hair of one frame stands still; the camera keeps its direction. Error: root mean square of
the picture with /lod's levels less that of level 0, display values counting from 0 to 1. Popping:
the same of what changes from one place to the next, less what changes at level 0. Coverage: share
of a square round the hair that it hides, without the head. Times: medians of isolated frames.)";

}  // namespace

void addPictureCommands(const CommandLine& line) {
    addCommand<ViewOptions>(
        line, line.app, "view", "opens a scene in a window", viewScene,
        [](CLI::App& command, ViewOptions& options) {
            addSceneOptions(command, options.scene);
            command.add_option("--width", options.width, "of the window (default 1600)");
            command.add_option("--height", options.height, "of the window (default 900)");
            command.add_option(
                "--scale", options.scale, "of letters and widgets (default the screen's)");
            command.add_option(
                "--frames", options.frames,
                "pictures of the window before it closes (default: never)");
            command.add_option("--screenshot", options.screenshot, "of the last one (.png)")
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
            command.add_option("--frames", options.frames, "frames to play (default 60)")
                ->check(CLI::PositiveNumber);
            command
                .add_option(
                    "--export", options.out,
                    "file; .usda holds every frame, other formats (see 'groom convert') the last")
                ->required()
                ->type_name("FILE");
            command.add_flag("--guides", options.guides, "the guides instead of the drawn strands");
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
            command.add_flag("--json", options.json, "as JSON");
        });
    addCommand<LodOptions>(
        line, line.app, "lod",
        "moves the camera away and compares level of detail by distance with full detail", walkLod,
        [](CLI::App& command, LodOptions& options) {
            addSceneOptions(command, options.scene);
            command
                .add_option("--from", options.from, "first distance from /camera/target, m (0.5)")
                ->check(CLI::PositiveNumber);
            command.add_option("--to", options.to, "last distance, m (20)")
                ->check(CLI::PositiveNumber);
            command.add_option("--steps", options.steps, "places, each as many times farther (40)")
                ->check(CLI::Range(2u, 10000u));
            command
                .add_option("-o,--out", options.out, "report file (default results/local/lod.json)")
                ->type_name("FILE");
            command.add_option(
                "--frame", options.frame, "frame whose hair is drawn, from 0 (default 0)");
            command.footer(kLodNotes);
        });
}

}  // namespace benchmarks
