#include "benchmarks/commands/command_line.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <sstream>
#include <string_view>
#include <utility>

#include "benchmarks/commands/command_line_options.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "engine/process.h"

namespace benchmarks::commands {
namespace {

constexpr const char* kExitStatus =
    R"(Exit status: 0 ok, 1 internal error or a full disk, 2 usage or invalid scene, 3 a check of the
physics or of doctor failed, 10 slower, 11 inconclusive, 12 pictures or states differ, 13 the
baseline is missing or comes from another device or scene, 14 nothing ran, 77 no suitable device,
130 interrupted (results so far are saved) or merged with cases missing.)";

// The commands of the program, declared for one command line.
struct Declared {
    explicit Declared(const std::vector<std::string>& arguments);

    CLI::App app{"hairbench: measures simulated and rendered hair on Vulkan devices", "hairbench"};
    Command chosen;
    std::map<const CLI::App*, CommandText> texts;
};

std::vector<CLI::App*> commandsOf(CLI::App& app) {
    return app.get_subcommands([](CLI::App*) { return true; });
}

// Adds the first example of each command, in the order of the list of commands.
void addFirstExamples(Declared& declared, CLI::App& app, std::vector<std::string>& examples) {
    for (CLI::App* const command : commandsOf(app)) {
        if (commandsOf(*command).empty())
            examples.push_back(declared.texts.at(command).examples.front());
        else
            addFirstExamples(declared, *command, examples);
    }
}

Declared::Declared(const std::vector<std::string>& arguments) {
    app.set_version_flag("--version", report::versionText());
    app.require_subcommand(1);
    app.allow_windows_style_options(false);  // "/strands/density" is a value
    const CommandLine line{.app = app, .chosen = chosen, .arguments = arguments, .texts = texts};
    addMeasuringCommands(line);
    addReportCommands(line);
    addPictureCommands(line);
    addGroomCommands(line);
    addCheckCommands(line);
    addProgramCommands(line);

    CommandText text{
        .name = "hairbench", .description = app.get_description(), .notes = kExitStatus};
    addFirstExamples(*this, app, text.examples);
    std::string footer = "Examples (COMMAND --help has more):";
    for (const std::string& example : text.examples) footer += "\n  " + example;
    app.footer(footer + '\n' + kExitStatus);
    texts[&app] = std::move(text);
}

// ---- Help as data -------------------------------------------------------------------------------

// "TEXT:{locked,free}" -> TEXT and its choices; "UINT:POSITIVE" -> UINT. Leaves types that an
// option names itself: "A:B[:STEP]".
void splitType(const std::string& type, OptionHelp& option) {
    option.value = type;
    if (const std::size_t list = type.find(":{"); list != std::string::npos) {
        option.value = type.substr(0, list);
        std::istringstream choices(type.substr(list + 2, type.find('}', list) - list - 2));
        for (std::string each; std::getline(choices, each, ',');) option.choices.push_back(each);
    }
    constexpr auto kNumbers = std::to_array<std::string_view>({"UINT:", "INT:", "FLOAT:", "TEXT:"});
    for (const std::string_view number : kNumbers)
        if (option.value.starts_with(number)) option.value.resize(number.size() - 1);
}

OptionHelp helpOf(const CLI::Option& option) {
    OptionHelp help{
        .description = option.get_description(),
        .required = option.get_required(),
        .repeated = option.get_items_expected_max() > 1 ||
                    option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll};
    for (const std::string& name : option.get_snames()) help.names.push_back('-' + name);
    for (const std::string& name : option.get_lnames()) help.names.push_back("--" + name);
    if (option.get_type_size_max() != 0) splitType(option.get_type_name(), help);
    return help;
}

CommandHelp helpOf(Declared& declared, CLI::App& app, std::vector<std::string> words) {
    const CommandText& text = declared.texts.at(&app);
    words.push_back(text.name);
    CommandHelp help{
        .words = words,
        .description = text.description,
        .notes = text.notes,
        .examples = text.examples};
    for (const CLI::Option* const option : app.get_options({}))
        help.options.push_back(helpOf(*option));
    for (CLI::App* const command : commandsOf(app))
        help.commands.push_back(helpOf(declared, *command, words));
    return help;
}

// Returns the arguments as CLI11 takes them: in reverse and without the program's name. `gate -a`
// becomes `gate --axis`: newer versions of CLI11 treat -a and --a as one name.
std::vector<std::string> parsedArguments(std::vector<std::string> words) {
    if (words.size() > 1 && words[1] == "gate") std::ranges::replace(words, "-a", "--axis");
    return {words.rbegin(), words.rend() - std::ptrdiff_t{!words.empty()}};
}

}  // namespace

CommandHelp programHelp() {
    Declared declared({});
    return helpOf(declared, declared.app, {});
}

std::string whyNotParsed(const std::vector<std::string>& words) {
    Declared declared(words);
    try {
        declared.app.parse(parsedArguments(words));
    } catch (const CLI::ParseError& error) {
        return error.what();
    }
    return {};
}

// ---- Running ------------------------------------------------------------------------------------

int runCommandLine(int argc, char** argv) {
    const std::vector<std::string> arguments(argv, argv + argc);
    Declared declared(arguments);
    try {
        declared.app.parse(parsedArguments(arguments));
    } catch (const CLI::ParseError& error) {
        return declared.app.exit(error) == 0 ? report::kOk : report::kUsageError;
    }
    engine::catchInterrupts();
    try {
        const measure::ProgressLine progress;
        return declared.chosen();
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted\n";
        return report::kInterrupted;
    }
}

}  // namespace benchmarks::commands
