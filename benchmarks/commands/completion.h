#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/commands/command_help.h"

// What shells complete, made from the command line's own help: commands, options, the values that
// there are, names of files and of the scenes that are shipped.
namespace benchmarks::commands {

// "bash", "zsh", "fish".
std::vector<std::string> shellNames();

// The file that has a shell complete the program's command line: bash and fish read it whenever
// the program's name is completed, zsh where it is _hairbench in a folder of $fpath.
std::string completionFor(std::string_view shell, const CommandHelp& program);

}  // namespace benchmarks::commands
