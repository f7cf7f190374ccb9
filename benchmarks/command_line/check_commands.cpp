#include "benchmarks/command_line/command_line.h"

namespace benchmarks {

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

    CLI::App* const validate =
        line.app.add_subcommand("validate", "checks scene files and their assets");
    const auto scenes = std::make_shared<std::vector<std::filesystem::path>>();
    validate->add_option("scenes", *scenes, "scene files")->required()->type_name("FILE...");
    validate->callback(
        [&chosen = line.chosen, scenes] { chosen = [scenes] { return validateScenes(*scenes); }; });
    line.app.add_subcommand("schema", "prints the JSON Schema of scene files")
        ->callback([&chosen = line.chosen] { chosen = printSchema; });
    line.app.add_subcommand("devices", "lists the Vulkan devices and what they lack")
        ->callback([&chosen = line.chosen] { chosen = printDevices; });
}

}  // namespace benchmarks
