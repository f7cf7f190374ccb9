#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

// The command line's own help as data, and the shell completions and manual pages made from it.
namespace benchmarks::commands {

// ---- Help as data -------------------------------------------------------------------------------

struct OptionHelp {
    std::vector<std::string> names;  // "-o", "--out"; empty: a positional argument
    std::string value;  // name of the value: "FILE", "UINT"; empty: takes no value
    std::vector<std::string> choices;  // allowed values; empty: not a list
    std::string description;
    bool required = false;
    bool repeated = false;  // may be given repeatedly, or takes several values
};

struct CommandHelp {
    std::vector<std::string> words;  // as typed: "hairbench", "groom", "info"
    std::string description;
    std::string notes;  // lines
    std::vector<std::string> examples;
    std::vector<OptionHelp> options;  // in the order of --help
    std::vector<CommandHelp> commands;
};

// Returns the typed name: "hairbench groom info".
inline std::string typedName(const CommandHelp& command) {
    std::string name;
    for (const std::string& word : command.words) name += (name.empty() ? "" : " ") + word;
    return name;
}

// Returns a command and all its subcommands, in depth-first order.
inline std::vector<const CommandHelp*> withCommandsBelow(const CommandHelp& command) {
    std::vector<const CommandHelp*> all{&command};
    for (const CommandHelp& each : command.commands)
        std::ranges::copy(withCommandsBelow(each), std::back_inserter(all));
    return all;
}

// The kinds of values that a shell can complete.
enum class ValueKind { none, text, choice, file, folder, scene };
inline ValueKind kindOf(const OptionHelp& option) {
    // These lists contain the names that the command line uses for paths.
    constexpr auto kFiles = std::to_array<std::string_view>(
        {"FILE", "A", "B", "CMD_OR_BUILD", "HEAD", "IN", "OUT", "PNG", "REPORT"});
    constexpr auto kFolders = std::to_array<std::string_view>({"DIR", "FOLDER"});
    std::string_view value = option.value;
    if (value.empty()) return ValueKind::none;
    if (!option.choices.empty()) return ValueKind::choice;
    if (value.ends_with("...")) value.remove_suffix(3);
    if (value == "SCENE") return ValueKind::scene;
    if (std::ranges::find(kFiles, value) != kFiles.end()) return ValueKind::file;
    if (std::ranges::find(kFolders, value) != kFolders.end()) return ValueKind::folder;
    return ValueKind::text;
}

// ---- Files made from it -------------------------------------------------------------------------

// "bash", "zsh", "fish".
std::vector<std::string> shellNames();

// Returns the completion file for a shell. bash and fish read it when the program's name is
// completed, zsh from a file _hairbench in a folder of $fpath.
std::string completionFor(std::string_view shell, const CommandHelp& program);

// "hairbench-groom-info.1"
std::string manualFile(const CommandHelp& command);

// Returns the page of a command of `program`, or of the program itself: roff with the macros of
// man(7).
std::string manualPage(const CommandHelp& command, const CommandHelp& program);

}  // namespace benchmarks::commands
