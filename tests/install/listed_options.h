#pragma once

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "benchmarks/commands/command_help.h"
#include "tests/cli/run_hairbench.h"

// Returns the command's words without the program's name: "groom info".
inline std::string wordsBelow(const benchmarks::commands::CommandHelp& command) {
    const std::string name = benchmarks::commands::typedName(command);
    const std::size_t space = name.find(' ');
    return space == std::string::npos ? "" : name.substr(space + 1);
}

// Returns the output of --help, which runs once for each command.
inline const std::string& helpText(const benchmarks::commands::CommandHelp& command) {
    static std::map<std::string, std::string> texts;
    const std::string words = wordsBelow(command);
    const auto [text, is_new] = texts.try_emplace(words);
    if (is_new) text->second = hairbench(words + " --help").output;
    return text->second;
}

// Returns the options in the output of --help, as CLI11 lists them: "  -o,--out FILE ...".
inline std::set<std::string> listedOptions(const benchmarks::commands::CommandHelp& command) {
    static const std::regex line_pattern("  (-[-,a-zA-Z]*).*");
    std::set<std::string> options;
    std::istringstream help(helpText(command));
    for (std::string line; std::getline(help, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, line_pattern)) continue;
        std::istringstream names(match[1].str());
        for (std::string name; std::getline(names, name, ',');) options.insert(name);
    }
    return options;
}

// Returns the commands in the output of --help: "  run                         plays ...".
inline std::set<std::string> listedCommands(const benchmarks::commands::CommandHelp& command) {
    static const std::regex line_pattern("  ([a-z]+) .*");
    std::set<std::string> commands;
    std::istringstream help(helpText(command));
    bool begun = false;
    for (std::string line; std::getline(help, line);) {
        if (line == "Subcommands:") begun = true;
        if (line.starts_with("Example")) break;
        std::smatch match;
        if (begun && std::regex_match(line, match, line_pattern)) commands.insert(match[1]);
    }
    return commands;
}
