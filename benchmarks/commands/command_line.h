#pragma once

#include <string>
#include <vector>

#include "benchmarks/commands/command_help.h"

// The command line: which commands there are, their options and help.
namespace benchmarks::commands {

// Parses the command line and runs the command that it names; the exit status. Prints help, the
// version and errors of the command line. Throws what the command throws.
int runCommandLine(int argc, char** argv);

// What --help says of the program and of all its commands.
CommandHelp programHelp();

// Why these words, the program's name first, are no command line; empty where they are one. Nothing
// is run.
std::string whyNotParsed(const std::vector<std::string>& words);

}  // namespace benchmarks::commands
