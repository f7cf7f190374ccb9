#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "benchmarks/report/compare.h"
#include "benchmarks/scene/sweep.h"
#include "engine/device.h"

// Helpers to declare commands: a call for each, and the options that several of them share.
namespace benchmarks::commands {

// The action that the parsed command line asks for.
using Command = std::function<int()>;

// Help text of a command, without its options.
struct CommandText {
    std::string name;
    std::string description;
    std::vector<std::string> examples;  // command lines, most common first
    std::string notes = {};  // lines of at most 100 columns
};

// Context for adding commands. The parsed command stores its action in `chosen`. `arguments` is the
// whole command line, as reports quote it; `texts` collects the help text of each command.
struct CommandLine {
    CLI::App& app;
    Command& chosen;
    const std::vector<std::string>& arguments;
    std::map<const CLI::App*, CommandText>& texts;
};

// Adds a command without options, or a parent of other commands.
CLI::App* addPlainCommand(const CommandLine& line, CLI::App& parent, const CommandText& text);

// Refuses infinity and NaN, which CLI11 reads as numbers.
void refuseWhatIsNotFinite(CLI::App& command);

// Adds a command whose options live as long as the app.
template <class Options>
CLI::App* addCommand(
    const CommandLine& line, CLI::App& parent, const CommandText& text, int (*run)(const Options&),
    const std::function<void(CLI::App&, Options&)>& add_options) {
    CLI::App* const command = addPlainCommand(line, parent, text);
    const auto options = std::make_shared<Options>();
    if constexpr (requires { options->command; }) options->command = line.arguments;
    add_options(*command, *options);
    refuseWhatIsNotFinite(*command);
    command->callback([&chosen = line.chosen, options, run] {
        chosen = [options, run] { return run(*options); };
    });
    return command;
}

// Adds a command without options.
void addCommand(const CommandLine& line, CLI::App& parent, const CommandText& text, int (*run)());

// ---- Options that several commands have ---------------------------------------------------------

// "2%" and "0.02" -> 0.02
std::string asShare(std::string& text);

// Adds an option that may be repeated, with one value each time.
CLI::Option* addRepeated(
    CLI::App& command, const std::string& name, std::vector<std::string>& values,
    const std::string& description);

// Adds an argument or option called `name` for one or more scenes, which may be shipped ones.
template <class Value>
CLI::Option*
addScene(CLI::App& command, const std::string& name, Value& value, const std::string& description) {
    return command.add_option(name, value, description)
        ->required()
        ->transform(CLI::Validator(
            [](std::string& text) {
                text = scene::sceneNamed(text).string();
                return std::string();
            },
            ""));
}

void addDeviceOptions(CLI::App& command, engine::DeviceOptions& options);
void addCacheOption(CLI::App& command, scene::SceneOptions& options);
void addOutsideOption(CLI::App& command, scene::Outside& outside);
void addSceneOptions(CLI::App& command, scene::SceneOptions& options);
void addSamplingOptions(CLI::App& command, scene::SceneOptions& options);
void addVerdictOptions(CLI::App& command, report::VerdictOptions& options);
void addFailOnInconclusive(CLI::App& command, report::VerdictOptions& options);

// ---- Commands by topic --------------------------------------------------------------------------

void addMeasuringCommands(const CommandLine& line);  // run, gate, shaders, ablate, doctor
void addReportCommands(const CommandLine& line);  // compare, report, convert, merge
void addPictureCommands(const CommandLine& line);  // view, render, simulate, export, reference ...
void addGroomCommands(const CommandLine& line);
void addCheckCommands(const CommandLine& line);  // physics, validate, schema, devices
void addProgramCommands(const CommandLine& line);  // scenes, completion, man

}  // namespace benchmarks::commands
