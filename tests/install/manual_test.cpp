// Tests the pages of the manual.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/commands/command_help.h"
#include "benchmarks/commands/command_line.h"
#include "tests/install/listed_options.h"
#include "tests/temporary_folder.h"

namespace benchmarks::commands {
namespace {

using testing::HasSubstr;

bool hasTool(const std::string& tool) {
    return runInShell("command -v " + tool + " >/dev/null").status == 0;
}

// Escapes hyphens for roff.
std::string withMinuses(const std::string& text) {
    std::string result;
    for (const char each : text) result += each == '-' ? "\\-" : std::string{each};
    return result;
}

TEST(Manual, NamesEveryCommandAndOption) {
    const CommandHelp program = programHelp();
    for (const CommandHelp* const command : withCommandsBelow(program)) {
        const std::string page = manualPage(*command, program);
        for (const std::string& option : listedOptions(*command))
            EXPECT_THAT(page, HasSubstr("\\fB" + withMinuses(option) + "\\fR"))
                << typedName(*command);
        for (const std::string& each : listedCommands(*command))
            EXPECT_THAT(page, HasSubstr(".TP\n\\fB" + each + "\\fR\n")) << typedName(*command);
    }
}

// mandoc and groff, which display such pages, find no fault in any page.
TEST(Manual, IsWithoutFault) {
    const TemporaryFolder folder;
    ASSERT_EQ(hairbench("man --out '" + folder.path().string() + "'").status, 0);
    const std::string pages = "'" + folder.path().string() + "'/*.1";
    const CommandHelp program = programHelp();
    EXPECT_EQ(
        runInShell("ls " + pages + " | wc -l").output,
        std::to_string(withCommandsBelow(program).size()) + '\n');
    if (hasTool("mandoc")) {  // generated pages have no date
        const std::string lint = "mandoc -T lint -W warning " + pages;
        EXPECT_EQ(runInShell(lint + " | grep -v 'missing date'").output, "");
    }
    if (hasTool("groff")) {
        EXPECT_EQ(runInShell("groff -man -Tutf8 -ww -z " + pages + " 2>&1").output, "");
    }
    if (!hasTool("mandoc") && !hasTool("groff")) GTEST_SKIP() << "neither mandoc nor groff";
}

TEST(Manual, IsShownByMan) {
    if (!hasTool("man")) GTEST_SKIP() << "no man";
    const Outcome shown = runInShell(
        "'" HAIRBENCH_PROGRAM "' man groom info | MANWIDTH=100 man -P cat -l - 2>&1 | col -b");
    EXPECT_THAT(
        shown.output, HasSubstr("hairbench-groom-info - shows what a file of hair contains"));
    EXPECT_THAT(shown.output, HasSubstr("--points-per-strand UINT"));
    EXPECT_THAT(shown.output, HasSubstr("hairbench groom info mine.hair --mesh head.glb"));
    EXPECT_THAT(shown.output, HasSubstr("hairbench-groom(1)"));
}

TEST(Manual, SaysWhichCommandThereIsNot) {
    const Outcome outcome = hairbench("man groom inform");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "hairbench: hairbench groom has no command 'inform'\n");
}

}  // namespace
}  // namespace benchmarks::commands
