#pragma once

#include <string>
#include <vector>

// The command line's own help as data, for completions and manual pages.
namespace benchmarks::commands {

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
std::string typedName(const CommandHelp& command);

// Returns a command and all its subcommands, in depth-first order.
std::vector<const CommandHelp*> withCommandsBelow(const CommandHelp& command);

// The kinds of values that a shell can complete.
enum class ValueKind { none, text, choice, file, folder, scene };
ValueKind kindOf(const OptionHelp& option);

}  // namespace benchmarks::commands
