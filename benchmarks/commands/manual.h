#pragma once

#include <string>

#include "benchmarks/commands/command_help.h"

// Writes manual pages for man(1) from the command line's own help.
namespace benchmarks::commands {

// "hairbench-groom-info.1"
std::string manualFile(const CommandHelp& command);

// Returns the page of a command of `program`, or of the program itself: roff with the macros of
// man(7).
std::string manualPage(const CommandHelp& command, const CommandHelp& program);

}  // namespace benchmarks::commands
