#include "benchmarks/commands/command_line_options.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/commands/help_files.h"

namespace benchmarks::commands {

void addProgramCommands(const CommandLine& line) {
    addCommand<ScenesOptions>(
        line, line.app,
        {.name = "scenes",
         .description = "lists the scenes that come with the program and their purposes",
         .examples = {"hairbench scenes"}},
        printScenes, [](CLI::App& command, ScenesOptions& options) {
            command.add_flag("--names", options.names, "print only their names");
        });
    addCommand<CompletionOptions>(
        line, line.app,
        {.name = "completion",
         .description = "prints the completion script of a shell",
         .examples = {"hairbench completion bash >> ~/.bash_completion"}},
        printCompletion, [](CLI::App& command, CompletionOptions& options) {
            command.add_option("shell", options.shell, "name of the shell")
                ->required()
                ->type_name("SHELL")
                ->check(CLI::IsMember(shellNames()));
        });
    addCommand<ManualOptions>(
        line, line.app,
        {.name = "man",
         .description = "prints the manual page of the program or of a command",
         .examples = {"hairbench man run | man -l -", "hairbench man --out man1"}},
        printManual, [](CLI::App& command, ManualOptions& options) {
            command.add_option("command", options.words, "the command's words: groom info")
                ->type_name("COMMAND...");
            command
                .add_option(
                    "-o,--out", options.out, "folder for this page and those of its subcommands")
                ->type_name("FOLDER");
        });
}

}  // namespace benchmarks::commands
