#pragma once

#include <string>
#include <vector>

#include "benchmarks/commands/command_help.h"

// Declares the commands of the command line with their options and help.
namespace benchmarks::commands {

// Parses the command line, runs its command and returns the exit status. Prints help, the version
// and errors of the command line. Throws whatever the command throws.
int runCommandLine(int argc, char** argv);

// Returns the text of --help for the program and all its commands.
CommandHelp programHelp();

// Returns the error of a command line, whose first word is the program's name; empty if it is
// valid. Runs nothing.
std::string whyNotParsed(const std::vector<std::string>& words);

}  // namespace benchmarks::commands
