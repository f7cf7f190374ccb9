#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/commands/command_help.h"

// Writes shell completions from the command line's own help: commands, options, allowed values,
// file names and names of shipped scenes.

namespace benchmarks::commands {

// "bash", "zsh", "fish".
std::vector<std::string> shellNames();

// Returns the completion file for a shell. bash and fish read it when the program's name is
// completed, zsh from a file _hairbench in a folder of $fpath.
std::string completionFor(std::string_view shell, const CommandHelp& program);

// Writes manual pages for man(1) from the command line's own help.

// "hairbench-groom-info.1"
std::string manualFile(const CommandHelp& command);

// Returns the page of a command of `program`, or of the program itself: roff with the macros of
// man(7).
std::string manualPage(const CommandHelp& command, const CommandHelp& program);

}  // namespace benchmarks::commands
