#include <iostream>

#include "benchmarks/commands/command_line.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "engine/instance.h"

namespace {

using namespace benchmarks;

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

int dispatch(int argc, char** argv) {
    CLI::App app("hairbench: measures simulated and rendered hair on Vulkan devices", "hairbench");
    app.set_version_flag("--version", report::versionText());
    app.require_subcommand(1);
    app.footer(kExamples);

    const std::vector<std::string> arguments(argv, argv + argc);
    commands::Command chosen;
    const commands::CommandLine line{.app = app, .chosen = chosen, .arguments = arguments};
    commands::addMeasuringCommands(line);
    commands::addReportCommands(line);
    commands::addPictureCommands(line);
    commands::addGroomCommands(line);
    commands::addCheckCommands(line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? report::kOk : report::kUsageError;
    }
    return chosen();
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return dispatch(argc, argv);
    } catch (const engine::NoDevice& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return report::kNoDevice;
    } catch (const engine::Error& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return report::kUsageError;
    } catch (const std::exception& error) {
        std::cerr << "hairbench: internal error: " << error.what() << '\n';
        return report::kInternalError;
    }
}
