#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "benchmarks/commands/commands.h"

// The command line: which commands there are, their options and help. One file for each group.
namespace benchmarks::commands {

// What the parsed command line asks for.
using Command = std::function<int()>;

// Each adds its commands to `app`; the one that is parsed puts what it does into `chosen`.
// `arguments`: all of the command line, as reports quote it.
struct CommandLine {
    CLI::App& app;
    Command& chosen;
    const std::vector<std::string>& arguments;
};
void addMeasuringCommands(const CommandLine& line);
void addReportCommands(const CommandLine& line);
void addPictureCommands(const CommandLine& line);
void addGroomCommands(const CommandLine& line);
void addCheckCommands(const CommandLine& line);

// Options that several commands have.
void addDeviceOptions(CLI::App& command, engine::DeviceOptions& options);
void addSceneOptions(CLI::App& command, scene::SceneOptions& options);
void addSamplingOptions(CLI::App& command, scene::SceneOptions& options);
void addVerdictOptions(CLI::App& command, report::VerdictOptions& options);
CLI::Option* addRepeated(
    CLI::App& command, const std::string& name, std::vector<std::string>& values,
    const std::string& description);

// A command whose options live as long as the app.
template <class Options>
CLI::App* addCommand(
    const CommandLine& line, CLI::App& parent, const std::string& name,
    const std::string& description, int (*run)(const Options&),
    const std::function<void(CLI::App&, Options&)>& add_options) {
    CLI::App* const command = parent.add_subcommand(name, description);
    const auto options = std::make_shared<Options>();
    if constexpr (requires { options->command; }) options->command = line.arguments;
    add_options(*command, *options);
    command->callback([&chosen = line.chosen, options, run] {
        chosen = [options, run] { return run(*options); };
    });
    return command;
}

}  // namespace benchmarks::commands
