#include "benchmarks/commands/manual.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <sstream>
#include <string_view>

#include "benchmarks/commands/command_line.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::commands {
namespace {

// ---- roff ---------------------------------------------------------------------------------------

// Escapes text for roff: '-' becomes a minus, which can be copied as typed, and no line begins a
// request.
std::string roff(std::string_view text) {
    std::string result;
    bool line_begins = true;
    for (const char each : text) {
        if (line_begins && (each == '.' || each == '\'')) result += "\\&";
        switch (each) {
        case '\\':
            result += "\\e";
            break;
        case '-':
            result += "\\-";
            break;
        case '\'':
            result += "\\(aq";
            break;
        case '^':
            result += "\\(ha";
            break;
        case '~':
            result += "\\(ti";
            break;
        default:
            result += each;
        }
        line_begins = each == '\n';
    }
    return result;
}

// Returns the lines without filling.
std::string verbatim(const std::vector<std::string>& lines) {
    std::string text = ".nf\n";
    for (const std::string& line : lines) text += roff(line) + '\n';
    return text + ".fi\n";
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

// ---- Parts of a page ----------------------------------------------------------------------------

std::string pageName(const CommandHelp& command) {
    std::string name;
    for (const std::string& word : command.words) name += (name.empty() ? "" : "-") + word;
    return name;
}

std::string synopsis(const CommandHelp& command) {
    std::string text = bold(typedName(command));
    if (!command.commands.empty()) text += ' ' + italic("COMMAND");
    text += " [" + italic("OPTION") + " ...]";
    for (const OptionHelp& option : command.options) {
        if (!option.names.empty() && !option.required) continue;
        std::string one = option.names.empty() ? "" : bold(option.names.back()) + ' ';
        one += italic(option.value);
        text += option.required ? ' ' + one : " [" + one + ']';
    }
    return text + '\n';
}

std::string optionText(const OptionHelp& option) {
    std::string text = ".TP\n";
    for (const std::string& name : option.names)
        text += (&name == &option.names.front() ? "" : ", ") + bold(name);
    if (!option.value.empty()) text += (option.names.empty() ? "" : " ") + italic(option.value);
    text += '\n' + roff(option.description);
    if (!option.choices.empty()) {
        text += ": one of";
        for (const std::string& choice : option.choices)
            text += (&choice == &option.choices.front() ? " " : ", ") + bold(choice);
    }
    return text + '\n';
}

std::string optionTexts(const CommandHelp& command) {
    std::string arguments, options;
    for (const OptionHelp& option : command.options)
        (option.names.empty() ? arguments : options) += optionText(option);
    if (!arguments.empty()) arguments.insert(0, ".SH ARGUMENTS\n");
    return arguments + ".SH OPTIONS\n" + options;
}

std::string commandTexts(const CommandHelp& command) {
    if (command.commands.empty()) return {};
    std::string text = ".SH COMMANDS\n";
    for (const CommandHelp& each : command.commands)
        text += ".TP\n" + bold(each.words.back()) + '\n' + roff(each.description) + '\n';
    return text;
}

std::string notesText(const CommandHelp& command) {
    if (command.notes.empty()) return {};
    std::vector<std::string> lines;
    std::istringstream notes(command.notes);
    for (std::string line; std::getline(notes, line);) lines.push_back(line);
    // Lists keep their line breaks; sentences are filled.
    const bool is_list =
        std::ranges::any_of(lines, [](const std::string& each) { return each.starts_with(' '); });
    return ".SH NOTES\n" + (is_list ? verbatim(lines) : roff(command.notes) + '\n');
}

struct Variable {
    const char* name;
    const char* help;
};

constexpr auto kVariables = std::to_array<Variable>({
    {"HAIRBENCH_PYTHON", "the Python interpreter that reads USD files"},
    {"HAIRBENCH_REFERENCE_PYTHON",
     "the Python interpreter of 'hairbench reference' and 'hairbench diff'"},
    {"HAIRBENCH_PLOTLY",
     "the plotly.js bundle for 'hairbench report', compressed with gzip or not"},
    {"HAIRBENCH_BASELINES",
     "the folder of 'run --save-baseline' (default results/local/baselines)"},
    {"XDG_CACHE_HOME", "the folder that holds hairbench/, the cache (default ~/.cache)"},
    {"XDG_CONFIG_HOME",
     "the folder that holds hairbench/, the viewer's preferences (default ~/.config)"},
    {"XDG_DATA_HOME",
     "the folder that holds hairbench/, the Python environments (default ~/.local/share)"},
});

std::string environmentText() {
    std::string text = ".SH ENVIRONMENT\n";
    for (const Variable& each : kVariables)
        text += ".TP\n" + bold(each.name) + '\n' + roff(each.help) + '\n';
    return text;
}

// Lists the program and the commands above and below in the hierarchy.
std::string seeAlso(const CommandHelp& command, const CommandHelp& program) {
    std::string text;
    for (const CommandHelp* const each : withCommandsBelow(program)) {
        const std::size_t shorter = std::min(each->words.size(), command.words.size());
        const bool is_in_line = std::equal(
            each->words.begin(), each->words.begin() + static_cast<std::ptrdiff_t>(shorter),
            command.words.begin());
        if (each->words == command.words || !is_in_line) continue;
        text += (text.empty() ? "" : ",\n") + bold(pageName(*each)) + "(1)";
    }
    return text.empty() ? "" : ".SH \"SEE ALSO\"\n" + text + '\n';
}

const CommandHelp& commandOf(const CommandHelp& program, const std::vector<std::string>& words) {
    const CommandHelp* command = &program;
    for (const std::string& word : words) {
        const auto below = std::ranges::find_if(
            command->commands, [&](const CommandHelp& each) { return each.words.back() == word; });
        if (below == command->commands.end())
            throw engine::Error(typedName(*command) + " has no command '" + word + '\'');
        command = &*below;
    }
    return *command;
}

}  // namespace

// ---- Pages --------------------------------------------------------------------------------------

std::string manualFile(const CommandHelp& command) { return pageName(command) + ".1"; }

std::string manualPage(const CommandHelp& command, const CommandHelp& program) {
    std::string title = pageName(command);
    std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string version = report::versionText();
    version.resize(std::min(version.find('\n'), version.size()));
    std::string text = ".TH " + title + " 1 \"\" \"" + roff(version) + "\" \"hairbench\"\n";
    text += ".SH NAME\n" + roff(pageName(command)) + " \\- " + roff(command.description) + '\n';
    text += ".SH SYNOPSIS\n" + synopsis(command);
    text += commandTexts(command) + optionTexts(command) + notesText(command);
    if (&command == &program) text += environmentText();
    text += ".SH EXAMPLES\n" + verbatim(command.examples);
    return text + seeAlso(command, program);
}

int printManual(const ManualOptions& options) {
    const CommandHelp program = programHelp();
    const CommandHelp& command = commandOf(program, options.words);
    if (options.out.empty()) {
        std::cout << manualPage(command, program);
        return report::kOk;
    }
    for (const CommandHelp* const each : withCommandsBelow(command))
        engine::writeFileAtomically(options.out / manualFile(*each), manualPage(*each, program));
    return report::kOk;
}

}  // namespace benchmarks::commands
