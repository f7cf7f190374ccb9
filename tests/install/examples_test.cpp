// The examples in a command's --help parse as command lines of this command.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/commands/command_line.h"
#include "tests/install/listed_options.h"

namespace benchmarks::commands {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Returns the words that a shell passes to the program, up to a pipe or a redirection, unquoted.
std::vector<std::string> shellWords(const std::string& line) {
    const std::size_t end = std::min(line.find(" |"), line.find(" >"));
    const Outcome outcome = runInShell("printf '%s\\n' " + line.substr(0, end));
    std::vector<std::string> words;
    std::istringstream lines(outcome.output);
    for (std::string word; std::getline(lines, word);) words.push_back(word);
    return words;
}

TEST(Examples, AreCommandLinesOfTheirCommand) {
    const CommandHelp program = programHelp();
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        EXPECT_THAT(command->examples, Not(IsEmpty())) << typedName(*command);
        for (const std::string& example : command->examples) {
            EXPECT_EQ(whyNotParsed(shellWords(example)), "") << example;
            EXPECT_TRUE(example.starts_with(typedName(*command))) << example;
        }
    }
}

TEST(Examples, AreInTheHelpOfTheirCommand) {
    const CommandHelp program = programHelp();
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        const Outcome help = hairbench(wordsBelow(*command) + " --help");
        EXPECT_EQ(help.status, 0);
        for (const std::string& example : command->examples)
            EXPECT_THAT(help.output, HasSubstr("  " + example + '\n'));
    }
}

// The parser of this test refuses wrong command lines.
TEST(Examples, WouldBeRefusedWithAnOptionThatThereIsNot) {
    EXPECT_THAT(whyNotParsed({"hairbench", "run", "smoke", "--no-such"}), HasSubstr("--no-such"));
    EXPECT_THAT(whyNotParsed({"hairbench", "render", "smoke"}), HasSubstr("--out"));
    EXPECT_THAT(whyNotParsed({"hairbench"}), Not(IsEmpty()));
    EXPECT_EQ(
        whyNotParsed(
            {"hairbench", "gate", "--a", "old", "--b", "new", "--scene", "smoke", "-a",
             "/render/msaa=1,4", "--margin", "3%"}),
        "");
}

// Completions and the manual are made from the entries that --help lists.
TEST(ProgramHelp, HasTheCommandsAndOptionsOfHelp) {
    const CommandHelp program = programHelp();
    ASSERT_GT(program.commands.size(), 20u);
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        std::set<std::string> options, commands;
        for (const OptionHelp& option : command->options)
            options.insert(option.names.begin(), option.names.end());
        for (const CommandHelp& each : command->commands) commands.insert(each.words.back());
        EXPECT_EQ(options, listedOptions(*command)) << typedName(*command);
        EXPECT_EQ(commands, listedCommands(*command)) << typedName(*command);
    }
}

}  // namespace
}  // namespace benchmarks::commands
