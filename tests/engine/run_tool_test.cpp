#include "engine/run_tool.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/error_text.h"
#include "tests/temporary_folder.h"

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
        "needed more than 1 s of CPU time");
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
        "needed more than 256 MiB of memory");
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
        return errorText([&] { runTool({"cat", "/dev/zero"}, {.output = bytes}); });
    };
    EXPECT_EQ(most(1000000), "cat wrote more than 1000000 bytes");
    EXPECT_EQ(runTool({"printf", "four"}, {.output = 4}).size(), 4u);
}

TEST(RunTool, HandsOverLines) {
    std::vector<std::string> lines;
    runTool(
        {"sh", "-c", "printf 'a\\nb'; sleep 0.05; printf 'c\\n\\nend'"},
        [&](std::string_view l) { lines.emplace_back(l); });
    EXPECT_EQ(lines, (std::vector<std::string>{"a", "bc", "", "end"}));
}

// If the error did not end the program, this would take a minute.
TEST(RunTool, EndsTheProgramWhereALineIsRefused) {
    EXPECT_EQ(
        errorText([] {
            runTool({"sh", "-c", "echo no; exec sleep 60"}, [](std::string_view line) {
                throw engine::Error(std::string(line));
            });
        }),
        "no");
}

// Tests a program without output.
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

TEST(RunTool, EndsWhatTakesTooMuchOfTheProcessor) {
    EXPECT_EQ(
        errorText([] { runTool({"sh", "-c", "while :; do :; done"}, {.seconds = 1}); }),
        "sh needed more than 1 s of CPU time");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(RunTool, GivesNoMoreMemoryThanIsAllowed) {
    const std::string grow = "x=1234567890123456; while :; do x=$x$x; done";
    EXPECT_NE(
        errorText(
            [&] { runTool({"sh", "-c", grow}, {.seconds = 10, .bytes = std::size_t{64} << 20}); }),
        "sh needed more than 10 s of CPU time");
}
#endif

// prctl(2), PR_SET_PDEATHSIG. Otherwise the child of a killed program would run on for a minute.
TEST(RunTool, EndsTheProgramWithItsParent) {
    const TemporaryFolder folder;
    const std::string script = "echo $$ >'" + folder.file("child").string() + "'; exec sleep 60";
    const pid_t parent = fork();
    if (parent == 0) {
        try {
            runTool({"sh", "-c", script});
        } catch (...) {
        }
        _exit(0);
    }
    const auto waitFor = [](const auto& done) {
        for (int i = 0; i < 500 && !done(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return done();
    };
    pid_t child = 0;
    ASSERT_TRUE(waitFor([&] { return bool(std::ifstream(folder.file("child")) >> child); }));
    EXPECT_EQ(kill(child, 0), 0);
    EXPECT_EQ(getpgid(child), child);  // a group of its own
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    const auto isGone = [&] {
        char state = 'X';  // an orphan that nobody waits for stays a zombie
        std::string stat = textOf("/proc/" + std::to_string(child) + "/stat");
        if (const auto end = stat.rfind(") "); end != std::string::npos) state = stat[end + 2];
        return state == 'X' || state == 'Z';
    };
    EXPECT_TRUE(waitFor(isGone));
}

TEST(RunTool, GivesVariablesOfAListAlone) {
    setenv("HAIRBENCH_SECRET", "mine", 1);
    const auto seen = [](const ChildLimits& limits) {
        const auto bytes = runTool({"env"}, limits);
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    EXPECT_THAT(seen({}), testing::HasSubstr("HAIRBENCH_SECRET=mine"));
    EXPECT_THAT(
        seen({.reads = std::vector<std::filesystem::path>{}}),
        testing::AllOf(
            testing::HasSubstr("PATH="), testing::Not(testing::HasSubstr("HAIRBENCH_SECRET"))));
    unsetenv("HAIRBENCH_SECRET");
}

// landlock(7).
TEST(RunTool, OpensOnlyWhatItMayRead) {
    if (syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) < 1)
        GTEST_SKIP() << "this kernel has no Landlock";
    const TemporaryFolder folder;
    const std::string inside = folder.write("own/a.txt", "inside").string();
    const std::string outside = folder.write("b.txt", "outside").string();
    std::filesystem::create_symlink("../b.txt", folder.file("own/link"));
    const auto cat = [&](const std::string& file) {
        return runTool(
                   {"cat", file}, {.reads = std::vector<std::filesystem::path>{folder.file("own")}})
            .size();
    };
    EXPECT_EQ(cat(inside), 6u);
    EXPECT_THROW(cat(outside), Error);
    EXPECT_THROW(cat(folder.file("own/link").string()), Error);
    EXPECT_THROW(
        runTool(
            {"touch", folder.file("own/new").string()},
            {.reads = std::vector<std::filesystem::path>{folder.file("own")}}),
        Error);
}

// seccomp(2). Python's own errors name the number of the error, and its module `os` calls the
// kernel almost directly.
TEST(RunTool, CallsNeitherTheNetworkNorOtherProcesses) {
    const auto python = [](const std::string& code, ChildLimits limits) {
        return errorText([&] { runTool({"python3", "-c", code}, limits); });
    };
    const ChildLimits limited{.reads = std::vector<std::filesystem::path>{}};
    EXPECT_EQ(
        python("import threading as t; a = t.Thread(target=print); a.start(); a.join()", limited),
        "no error");
    for (const char* const call :
         {"import socket; socket.socket()", "import os; os.fork()",
          "import subprocess as s; s.run(['true'])"}) {
        EXPECT_EQ(python(call, {}), "no error") << call;
#ifndef __SANITIZE_ADDRESS__
        EXPECT_THAT(python(call, limited), testing::HasSubstr("[Errno 1]")) << call;
#endif
    }
}

// Work in a fork only computes.
TEST(RunApart, OpensAndStartsNothing) {
    EXPECT_EQ(
        runApart(
            [] {
                std::string text;
                text += std::ifstream("/proc/self/stat") ? 'o' : '-';
                text += socket(AF_INET, SOCK_STREAM, 0) >= 0 ? 's' : '-';
                execl("/bin/true", "true", nullptr);
                return text;
            },
            {.seconds = 10, .bytes = std::size_t{1} << 28}),
        "--");
}

TEST(RunTool, SaysThatThereIsNoSuchProgram) {
    EXPECT_THROW(runTool({"/no/such/program"}), std::system_error);
}

}  // namespace
}  // namespace engine
