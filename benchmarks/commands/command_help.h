#pragma once

#include <string>
#include <vector>

// The command line's own help as data, from which completions and manual pages are made.
namespace benchmarks::commands {

struct OptionHelp {
    std::vector<std::string> names;  // "-o", "--out"; empty: an argument by its place
    std::string value;  // what it is called: "FILE", "UINT"; empty: it takes none
    std::vector<std::string> choices;  // the values that there are; empty: not a list
    std::string description;
    bool required = false;
    bool repeated = false;  // may be given several times, or takes several values
};

struct CommandHelp {
    std::vector<std::string> words;  // as they are typed: "hairbench", "groom", "info"
    std::string description;
    std::string notes;  // lines
    std::vector<std::string> examples;
    std::vector<OptionHelp> options;  // in the order of --help
    std::vector<CommandHelp> commands;
};

// What is typed to get it: "hairbench groom info".
std::string typedName(const CommandHelp& command);

// A command and all below it, in that order.
std::vector<const CommandHelp*> withCommandsBelow(const CommandHelp& command);

// The kinds of values that a shell can complete.
enum class ValueKind { none, text, choice, file, folder, scene };
ValueKind kindOf(const OptionHelp& option);

}  // namespace benchmarks::commands
