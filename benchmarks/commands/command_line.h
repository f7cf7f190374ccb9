#pragma once

// The command line: which commands there are, their options and help.
namespace benchmarks::commands {

// Parses the command line and runs the command that it names; the exit status. Prints help, the
// version and errors of the command line. Throws what the command throws.
int runCommandLine(int argc, char** argv);

}  // namespace benchmarks::commands
