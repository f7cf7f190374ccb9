#include "benchmarks/commands/command_help.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <sstream>

#include "benchmarks/commands/command_line.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::commands {

// ---- Completions --------------------------------------------------------------------------------

namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
    std::string text;
    for (const std::string& word : words) text.append(text.empty() ? "" : between).append(word);
    return text;
}

// Quotes text for a POSIX shell.
std::string shellQuoted(std::string_view text) {
    std::string result = "'";
    for (const char each : text) result += each == '\'' ? std::string("'\\''") : std::string{each};
    return result + '\'';
}

// Returns the kind of a command's first positional argument. All positional arguments complete to
// it.
ValueKind argumentKind(const CommandHelp& command) {
    for (const OptionHelp& option : command.options)
        if (option.names.empty()) return kindOf(option);
    return ValueKind::none;
}

std::vector<std::string> argumentChoices(const CommandHelp& command) {
    for (const OptionHelp& option : command.options)
        if (option.names.empty()) return option.choices;
    return {};
}

// "hairbench groom info" -> "_hairbench_groom_info"
std::string functionName(const CommandHelp& command) { return '_' + joined(command.words, "_"); }

// ---- bash ---------------------------------------------------------------------------------------

constexpr const char* kBashStart =
    R"sh(# Completions of hairbench for bash, made by 'hairbench completion bash'.

# Names of files that begin with the word; folders end in a slash.
_hairbench_files() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen "$1" -- "$2")
}

_hairbench_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$2")
}

# A scene is a file or the name of one that is shipped.
_hairbench_scenes() {
    _hairbench_files -f "$2"
    local shipped
    mapfile -t shipped < <(compgen -W "$("$1" scenes --names 2>/dev/null)" -- "$2")
    COMPREPLY+=("${shipped[@]}")
}

_hairbench() {
    local program=$1 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local command=hairbench commands each i
    # --option=value comes as three words.
    if [[ $word == = ]]; then
        word=
    elif [[ $before == = ]]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    COMPREPLY=()
    for ((i = 1; i < COMP_CWORD; ++i)); do
        _hairbench_commands "$command"
        for each in $commands; do
            [[ ${COMP_WORDS[i]} == "$each" ]] && command+=" $each" && break
        done
    done
    if [[ $before == -* ]] && _hairbench_value "$program" "$command" "$before" "$word"; then
        return
    fi
    _hairbench_commands "$command"
    if [[ $word == -* ]]; then
        _hairbench_options "$command" "$word"
    elif [[ $commands ]]; then
        _hairbench_words "$commands" "$word"
    else
        _hairbench_argument "$program" "$command" "$word"
    fi
}
)sh";

// Returns the bash command that completes `word` to a value.
std::string
bashValue(ValueKind kind, const std::vector<std::string>& choices, const std::string& word) {
    switch (kind) {
    case ValueKind::choice:
        return "_hairbench_words " + shellQuoted(joined(choices)) + ' ' + word;
    case ValueKind::file:
        return "_hairbench_files -f " + word;
    case ValueKind::folder:
        return "_hairbench_files -d " + word;
    case ValueKind::scene:
        return "_hairbench_scenes \"$1\" " + word;
    default:
        return ":";
    }
}

std::string bashCompletion(const CommandHelp& program) {
    std::string commands, options, values, arguments;
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        const std::string name = shellQuoted(typedName(*command));
        std::vector<std::string> below, names;
        for (const CommandHelp& each : command->commands) below.push_back(each.words.back());
        for (const OptionHelp& option : command->options) {
            names.insert(names.end(), option.names.begin(), option.names.end());
            if (option.names.empty() || option.value.empty()) continue;
            for (const std::string& each : option.names)
                values += "        " + shellQuoted(typedName(*command) + ' ' + each) + ") " +
                          bashValue(kindOf(option), option.choices, "\"$4\"") + " ;;\n";
        }
        commands += "        " + name + ") commands=" + shellQuoted(joined(below)) + " ;;\n";
        options +=
            "        " + name + ") _hairbench_words " + shellQuoted(joined(names)) + " \"$2\" ;;\n";
        arguments += "        " + name + ") " +
                     bashValue(argumentKind(*command), argumentChoices(*command), "\"$3\"") +
                     " ;;\n";
    }
    return std::string(kBashStart) +
           "\n# Sets `commands` to those below a command.\n"
           "_hairbench_commands() {\n    case $1 in\n" +
           commands + "    esac\n}\n\n_hairbench_options() {\n    case $1 in\n" + options +
           "    esac\n}\n\n# Fails for an option that takes no value.\n"
           "_hairbench_value() {\n    case \"$2 $3\" in\n" +
           values +
           "        *) return 1 ;;\n    esac\n}\n\n_hairbench_argument() {\n    case $2 in\n" +
           arguments + "    esac\n}\n\ncomplete -F _hairbench hairbench\n";
}

// ---- zsh ----------------------------------------------------------------------------------------

// Escapes a description for a specification of _arguments or _describe.
std::string zshText(std::string_view text) {
    std::string result;
    for (const char each : text) {
        if (each == '[' || each == ']' || each == ':' || each == '\\') result += '\\';
        result += each;
    }
    return result;
}

std::string zshAction(const OptionHelp& option) {
    switch (kindOf(option)) {
    case ValueKind::choice:
        return '(' + joined(option.choices) + ')';
    case ValueKind::file:
        return "_files";
    case ValueKind::folder:
        return "_files -/";
    case ValueKind::scene:
        return "__hairbench_scenes";
    default:
        return " ";
    }
}

// Returns a word of _arguments: '(-o --out)'{-o,--out}'[report file]:FILE:_files'
std::string zshSpecification(const OptionHelp& option) {
    const std::string value =
        option.value.empty() ? "" : ':' + zshText(option.value) + ':' + zshAction(option);
    if (option.names.empty())
        return shellQuoted((option.repeated ? "*" : "") + (value.empty() ? ":" : value));
    const std::string text = '[' + zshText(option.description) + ']' + value;
    const std::string once = option.repeated ? "*" : '(' + joined(option.names) + ')';
    if (option.names.size() == 1) return shellQuoted(once + option.names.front() + text);
    return shellQuoted(once) + '{' + joined(option.names, ",") + '}' + shellQuoted(text);
}

std::string zshFunction(const CommandHelp& command) {
    std::string text = '\n' + functionName(command) + "() {\n";
    if (!command.commands.empty()) text += "    local curcontext=$curcontext state line\n";
    text += command.commands.empty() ? "    _arguments -s" : "    _arguments -C -s";
    for (const OptionHelp& option : command.options)
        text += " \\\n        " + zshSpecification(option);
    if (command.commands.empty()) return text + "\n}\n";
    text += " \\\n        '1: :->command' '*:: :->arguments'\n    case $state in\n"
            "    command)\n        local -a commands=(";
    for (const CommandHelp& each : command.commands)
        text += "\n            " + shellQuoted(each.words.back() + ':' + zshText(each.description));
    text += ")\n        _describe command commands\n        ;;\n"
            "    arguments)\n        case $line[1] in\n";
    for (const CommandHelp& each : command.commands)
        text += "        " + each.words.back() + ") " + functionName(each) + " ;;\n";
    return text + "        esac\n        ;;\n    esac\n}\n";
}

std::string zshCompletion(const CommandHelp& program) {
    std::string text = R"sh(#compdef hairbench
# Completions of hairbench for zsh, made by 'hairbench completion zsh'.

# A scene is a file or the name of one that is shipped.
__hairbench_scenes() {
    local -a shipped=(${(f)"$(hairbench scenes --names 2>/dev/null)"})
    _alternative 'files:file:_files' "scenes:shipped scene:compadd -a shipped"
}
)sh";
    for (const CommandHelp* const command : withCommandsBelow(program))
        text += zshFunction(*command);
    // zsh reads the file by autoload, as the function's body, or by source.
    return text + "\nif [[ $funcstack[1] == _hairbench ]]; then\n    _hairbench \"$@\"\nelse\n"
                  "    compdef _hairbench hairbench\nfi\n";
}

// ---- fish ---------------------------------------------------------------------------------------

constexpr const char* kFishStart =
    R"sh(# Completions of hairbench for fish, made by 'hairbench completion fish'.

# Whether this command is typed so far.
function __hairbench_at
    set -l typed
    for word in (commandline -opc)[2..]
        string match -q -- '-*' $word; and continue
        set -a typed $word
        __hairbench_has_commands "$typed"; or break
    end
    test "$typed" = "$argv"
end

complete -c hairbench -f
)sh";

std::string fishValue(const OptionHelp& option) {
    switch (kindOf(option)) {
    case ValueKind::choice:
        return " -a " + shellQuoted(joined(option.choices));
    case ValueKind::file:
        return " -F";
    case ValueKind::folder:
        return " -a '(__fish_complete_directories)'";
    case ValueKind::scene:
        return " -F -a '(hairbench scenes --names 2>/dev/null)'";
    default:
        return "";
    }
}

std::string fishCompletion(const CommandHelp& program) {
    std::string text = kFishStart;
    std::string groups;
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        const std::string words = joined({command->words.begin() + 1, command->words.end()});
        if (!command->commands.empty()) groups += ' ' + shellQuoted(words);
        const std::string start =
            "complete -c hairbench -n " + shellQuoted("__hairbench_at " + words);
        for (const CommandHelp& each : command->commands)
            text +=
                start + " -a " + each.words.back() + " -d " + shellQuoted(each.description) + '\n';
        for (const OptionHelp& option : command->options) {
            text += start;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.names.empty() && !option.value.empty()) text += " -r";
            text += fishValue(option);
            text += " -d " + shellQuoted(option.description) + '\n';
        }
    }
    return text + "\nfunction __hairbench_has_commands\n    contains -- \"$argv\"" + groups +
           "\nend\n";
}

// ---- Shells -------------------------------------------------------------------------------------

struct Shell {
    std::string_view name;
    std::string (*completion)(const CommandHelp& program);
};

constexpr auto kShells = std::to_array<Shell>({
    {"bash", bashCompletion},
    {"zsh", zshCompletion},
    {"fish", fishCompletion},
});

}  // namespace

std::vector<std::string> shellNames() {
    std::vector<std::string> names;
    for (const Shell& shell : kShells) names.emplace_back(shell.name);
    return names;
}

std::string completionFor(std::string_view shell, const CommandHelp& program) {
    const auto found = std::ranges::find(kShells, shell, &Shell::name);
    if (found == kShells.end())
        throw engine::Error("no completions for the shell '" + std::string(shell) + '\'');
    return found->completion(program);
}

int printCompletion(const CompletionOptions& options) {
    std::cout << completionFor(options.shell, programHelp());
    return report::kOk;
}

// ---- The manual ---------------------------------------------------------------------------------

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
