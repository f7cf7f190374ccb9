#include "engine/run_tool.h"

#include <string>
#include <system_error>

#include <atomic>
#include <csignal>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/error_text.h"

namespace engine {
namespace {

std::vector<std::byte> shell(const std::string& script) { return runTool({"sh", "-c", script}); }

std::string failure(const std::string& script) {
    return errorText([&] { shell(script); });
}

TEST(RunTool, ReturnsWhatTheProgramWrites) {
    const auto bytes = shell("printf 'a\\000b'; echo ignored >&2");
    EXPECT_EQ(
        std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        std::string("a\0b", 3));
}

TEST(RunApart, ReturnsWhatTheWorkReturns) {
    const std::string much(1000000, 'x');
    int here = 1;
    EXPECT_EQ(
        runApart(
            [&] {
                here = 2;
                return much;
            },
            {.seconds = 10, .bytes = std::size_t{1} << 30}),
        much);
    EXPECT_EQ(here, 1);  // the child changed its own copy
}

TEST(RunApart, EndsWhatTakesTooMuchOrCrashes) {
    const auto failed = [](const std::function<std::string()>& work) {
        return errorText([&] { runApart(work, {.seconds = 1, .bytes = std::size_t{1} << 28}); });
    };
    EXPECT_EQ(
        failed([] {
            for (std::atomic<int> i = 0; i >= 0;) {
            }
            return std::string();
        }),
        "not done after 1 s of the processor");
    EXPECT_EQ(failed([]() -> std::string { _exit(3); }), "ended with status 3");
    EXPECT_EQ(failed([]() -> std::string { throw Error("anything"); }), "ended with status 1");
    EXPECT_EQ(
        failed([] {
            std::signal(SIGSEGV, SIG_DFL);  // sanitizers handle the signal
            kill(getpid(), SIGSEGV);
            return std::string();
        }),
        "ended by signal 11");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_EQ(
        failed([] { return std::string(std::size_t{1} << 30, 'x'); }),
        "not done with 256 MiB of memory");
#endif
}

// Writes more than a pipe holds (64 KiB on Linux) to both outputs.
TEST(RunTool, TakesMuchOnBothOutputs) {
    const auto bytes = shell("head -c 1000000 /dev/zero >&2; head -c 2000000 /dev/zero");
    EXPECT_EQ(bytes.size(), 2000000u);
}

// Without the limit, this would never end.
TEST(RunTool, EndsWhatWritesTooMuch) {
    const auto most = [](std::size_t bytes) {
        return errorText([&] { runTool({"cat", "/dev/zero"}, bytes); });
    };
    EXPECT_EQ(most(1000000), "cat wrote more than 1000000 bytes");
    EXPECT_EQ(runTool({"printf", "four"}, 4).size(), 4u);
}

TEST(RunTool, HandsOverLines) {
    std::vector<std::string> lines;
    runTool(
        {"sh", "-c", "printf 'a\\nb'; sleep 0.05; printf 'c\\n\\nend'"},
        [&](std::string_view l) { lines.emplace_back(l); });
    EXPECT_EQ(lines, (std::vector<std::string>{"a", "bc", "", "end"}));
}

// Without that, this would take a minute.
TEST(RunTool, EndsTheProgramWhereALineIsRefused) {
    EXPECT_EQ(
        errorText([] {
            runTool({"sh", "-c", "echo no; exec sleep 60"}, [](std::string_view line) {
                throw engine::Error(std::string(line));
            });
        }),
        "no");
}

// The same for a program without output.
TEST(RunTool, EndsTheProgramWhereAPollThrows) {
    EXPECT_EQ(
        errorText([] {
            runTool(
                {"sleep", "60"}, [](std::string_view) {}, [] { throw engine::Error("enough"); });
        }),
        "enough");
}

TEST(RunTool, GivesTheProgramNothingToRead) { EXPECT_TRUE(shell("cat").empty()); }

TEST(RunTool, PassesArgumentsAsTheyAre) {
    const auto bytes = runTool({"printf", "%s", "$(rm -rf x) 'a' \"b\"\n"});
    EXPECT_EQ(
        std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        "$(rm -rf x) 'a' \"b\"\n");
}

TEST(RunTool, FailsWithTheLastLine) {
    EXPECT_EQ(failure("echo first >&2; echo 'the reason' >&2; echo; exit 3"), "the reason");
    EXPECT_EQ(failure("exit 3"), "sh ended with status 3");
    EXPECT_EQ(failure("echo words >&2; kill -SEGV $$"), "sh ended by signal 11");
}

TEST(RunTool, SaysThatThereIsNoSuchProgram) {
    EXPECT_THROW(runTool({"/no/such/program"}), std::system_error);
}

}  // namespace
}  // namespace engine
