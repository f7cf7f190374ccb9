// Tests the shells' completions of the program's command line.
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/commands/command_help.h"
#include "benchmarks/commands/command_line.h"
#include "tests/install/listed_options.h"
#include "tests/install/typed_shell.h"
#include "tests/temporary_folder.h"

namespace benchmarks::commands {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::IsSupersetOf;

bool isThere(const std::string& shell) {
    return runInShell("command -v " + shell + " >/dev/null").status == 0;
}

std::set<std::string> firstWords(const std::string& text) {
    std::set<std::string> words;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        words.insert(line.substr(0, line.find_first_of("\t ")));
    return words;
}

// Has a folder with a shell's completions, and a stand-in `hairbench` that lists scenes as the real
// program does and otherwise prints its arguments.
class Completion : public testing::Test {
protected:
    fs::path completionsOf(const std::string& shell) const {
        return folder.write(shell, completionFor(shell, programHelp()));
    }

    Completion() {
        fs::permissions(
            folder.write(
                "bin/hairbench", "#!/bin/sh\n[ \"$1\" != scenes ] || exec '" HAIRBENCH_PROGRAM
                                 "' \"$@\"\necho \"called: $*.\"\n"),
            fs::perms::owner_all);
        folder.write("work/mine.hair", "");
        folder.write("work/mine.json", "");
    }

    std::string atWork() const {
        return "cd '" + folder.file("work").string() + "'; PATH='" + folder.file("bin").string() +
               "':$PATH; ";
    }

    // Types these keys into a shell with completions, and returns the arguments that the program
    // gets.
    std::string called(TypedShell& shell, const std::string& keys) const {
        shell.type(keys + '\n');
        const std::string seen = shell.waitFor(".\r\n");
        const std::size_t at = seen.rfind("called: ");
        return at == std::string::npos ? "not called: " + seen : seen.substr(at + 8);
    }

    TemporaryFolder folder;
};

TEST_F(Completion, IsReadByItsShellWithoutAWord) {
    for (const std::string& shell : shellNames()) {
        if (!isThere(shell)) continue;  // at least bash exists
        const Outcome read = runInShell(shell + " -n '" + completionsOf(shell).string() + "' 2>&1");
        EXPECT_EQ(read.status, 0) << shell;
        EXPECT_EQ(read.output, "") << shell;
    }
    EXPECT_TRUE(isThere("bash"));
}

TEST_F(Completion, NamesEveryCommandAndOptionInBash) {
    const std::string script = folder
                                   .write(
                                       "complete.sh", "source '" + completionsOf("bash").string() +
                                                          R"('
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_hairbench true
printf '%s\n' "${COMPREPLY[@]}"
)")
                                   .string();
    const CommandHelp program = programHelp();
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        const auto completed = [&](const std::string& word) {
            const std::string words = typedName(*command) + " '" + word + '\'';
            return firstWords(runInShell("bash '" + script + "' " + words).output);
        };
        EXPECT_EQ(completed("-"), listedOptions(*command)) << typedName(*command);
        if (command->commands.empty()) continue;
        EXPECT_EQ(completed(""), listedCommands(*command)) << typedName(*command);
    }
}

TEST_F(Completion, CompletesWhatIsTypedIntoBash) {
    TypedShell shell({"bash", "--norc", "--noprofile", "-i"});
    shell.type(
        atWork() + "source '" + completionsOf("bash").string() +
        "'; bind 'set enable-bracketed-paste off'; PS1=rea; PS1+='dy> '\n");
    shell.waitFor("ready> ");
    EXPECT_EQ(called(shell, "hairbench ru\ttalk --max-t\t3"), "run talk --max-time 3.\r\n");
    EXPECT_EQ(called(shell, "hairbench run thes\t--clo\tlo\t"), "run thesis --clocks locked.\r\n");
    EXPECT_EQ(called(shell, "hairbench run portraits/bra\t"), "run portraits/braid.\r\n");
    EXPECT_EQ(called(shell, "hairbench run mine.j\t--dry\t"), "run mine.json --dry-run.\r\n");
    EXPECT_EQ(called(shell, "hairbench groo\tinf\tmine.h\t"), "groom info mine.hair.\r\n");
    EXPECT_EQ(called(shell, "hairbench conv\tmine.j\t-f cs\t"), "convert mine.json -f csv.\r\n");
    EXPECT_EQ(called(shell, "hairbench convert --format=mar\t"), "convert --format=markdown.\r\n");
}

TEST_F(Completion, CompletesWhatIsTypedIntoZsh) {
    if (!isThere("zsh")) GTEST_SKIP() << "no zsh";
    TypedShell shell({"zsh", "-f", "-i"});
    shell.type(
        atWork() + "autoload -U compinit; compinit -u -D; source '" +
        completionsOf("zsh").string() +
        "'; unset zle_bracketed_paste; unsetopt prompt_sp; PS1=rea; "
        "PS1+='dy> '\n");
    shell.waitFor("ready> ");
    EXPECT_EQ(called(shell, "hairbench ru\ttalk --max-t\t3"), "run talk --max-time 3.\r\n");
    EXPECT_EQ(called(shell, "hairbench run thes\t--clo\tlo\t"), "run thesis --clocks locked.\r\n");
    EXPECT_EQ(called(shell, "hairbench run mine.j\t--dry\t"), "run mine.json --dry-run.\r\n");
    EXPECT_EQ(called(shell, "hairbench groo\tinf\tmine.h\t"), "groom info mine.hair.\r\n");
    EXPECT_EQ(called(shell, "hairbench conv\tmine.j\t-f cs\t"), "convert mine.json -f csv.\r\n");
}

TEST_F(Completion, NamesEveryCommandAndOptionInZsh) {
    const std::string text = completionFor("zsh", programHelp());
    const CommandHelp program = programHelp();
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        std::string name = typedName(*command);
        std::ranges::replace(name, ' ', '_');
        const std::string function = "\n_" + name + "() {\n";
        const std::size_t at = text.find(function);
        ASSERT_NE(at, std::string::npos) << function;
        const std::string body = text.substr(at, text.find("\n}\n", at) - at);
        for (const std::string& option : listedOptions(*command))
            EXPECT_THAT(body, HasSubstr(option)) << typedName(*command);
        for (const std::string& each : listedCommands(*command))
            EXPECT_THAT(body, HasSubstr('\'' + each + ':')) << typedName(*command);
    }
}

TEST_F(Completion, NamesEveryCommandAndOptionInFish) {
    if (!isThere("fish")) GTEST_SKIP() << "no fish";
    const std::string file = completionsOf("fish").string();
    const CommandHelp program = programHelp();
    const auto completed = [&](const std::string& line) {
        return firstWords(runInShell(
                              atWork() + "export PATH HOME=$PWD; fish -N -c \"source '" + file +
                              "'; complete -C '" + line + "'\"")
                              .output);
    };
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        std::set<std::string> long_options = listedOptions(*command);
        std::erase_if(
            long_options, [](const std::string& each) { return !each.starts_with("--"); });
        EXPECT_EQ(completed(typedName(*command) + " --"), long_options) << typedName(*command);
        if (command->commands.empty()) continue;
        EXPECT_EQ(completed(typedName(*command) + ' '), listedCommands(*command))
            << typedName(*command);
    }
    EXPECT_THAT(completed("hairbench run thes"), IsSupersetOf({std::string("thesis")}));
}

}  // namespace
}  // namespace benchmarks::commands
