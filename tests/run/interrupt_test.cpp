// Tests signals during the program's long steps.
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/report/report.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// The program promises 2 s on an idle machine. Tests share a busy machine, where each of the
// program's waits may take longer. A step that ignored the signal would take minutes here.
constexpr auto kHeeded = 5s;
// Time to reach a step and see its progress.
constexpr auto kPatience = 180s;

// The program with a terminal as its stderr, for its progress, and a file as stdout.
class TerminalProcess {
public:
    TerminalProcess(std::vector<std::string> arguments, const fs::path& output) {
        arguments.insert(arguments.begin(), HAIRBENCH_PROGRAM);
        std::vector<char*> argv;
        for (std::string& argument : arguments) argv.push_back(argument.data());
        argv.push_back(nullptr);
        terminal_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (terminal_ < 0 || grantpt(terminal_) != 0 || unlockpt(terminal_) != 0)
            throw std::runtime_error("there is no pseudo-terminal");
        const std::string name = ptsname(terminal_);
        id_ = fork();
        if (id_ != 0) return;
        dup2(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        dup2(open(name.c_str(), O_RDWR | O_NOCTTY), STDERR_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
    TerminalProcess(const TerminalProcess&) = delete;
    TerminalProcess& operator=(const TerminalProcess&) = delete;
    ~TerminalProcess() {
        if (!ended()) {
            kill(SIGKILL);
            waitpid(id_, nullptr, 0);
        }
        close(terminal_);
    }

    // Whether it shows a match of `pattern` before it ends or kPatience passes.
    bool shows(const std::string& pattern) {
        const std::regex wanted(pattern);
        const Clock::time_point start = Clock::now();
        while (Clock::now() < start + kPatience && !ended()) {
            read(100ms);
            if (std::regex_search(shown_, wanted)) return true;
        }
        return false;
    }

    void kill(int signal) const { ::kill(id_, signal); }

    // Returns the time until it ends, or kPatience if it doesn't.
    Clock::duration end() {
        const Clock::time_point start = Clock::now();
        while (!ended() && Clock::now() < start + kPatience) read(10ms);
        return Clock::now() - start;
    }

    int status() const {
        return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
    }
    const std::string& shown() const { return shown_; }

private:
    bool ended() {
        if (!ended_) ended_ = waitpid(id_, &status_, WNOHANG) == id_;
        return ended_;
    }

    void read(std::chrono::milliseconds most) {
        pollfd ready{terminal_, POLLIN, 0};
        if (poll(&ready, 1, static_cast<int>(most.count())) <= 0) return;
        std::array<char, 4096> part{};
        const ssize_t size = ::read(terminal_, part.data(), part.size());
        if (size > 0)
            shown_.append(part.data(), static_cast<std::size_t>(size));
        else
            usleep(10'000);  // the other end is closed: not started yet, or ended
    }

    int terminal_;
    pid_t id_ = 0;
    bool ended_ = false;
    int status_ = 0;
    std::string shown_;
};

std::string scene(const std::string& name) { return HAIRBENCH_SCENES_DIR "/" + name; }

struct LongStep {
    const char* name;
    std::vector<std::string> arguments;  // OUT becomes a file of the test's folder
    const char* shown;  // output during the step
    int signal;
};

class LongSteps : public testing::TestWithParam<LongStep> {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
    }

    // Writes 2,000 straight strands of a metre in the format of USC-HairSalon.
    std::string writeStrands() const {
        const fs::path path = folder_.file("strands.data");
        std::ofstream file(path, std::ios::binary);
        const auto write = [&](const auto& value) {
            file.write(reinterpret_cast<const char*>(&value), sizeof value);
        };
        constexpr int kStrands = 2'000;
        write(kStrands);
        for (int i = 0; i < kStrands; ++i) {
            write(int{2});
            for (const float y : {0.0f, 1.0f}) {
                write(0.001f * static_cast<float>(i % 100));
                write(y);
                write(0.001f * static_cast<float>(i / 100));
            }
        }
        return path.string();
    }

    TemporaryFolder folder_;
};

TEST_P(LongSteps, EndSoonWhenInterrupted) {
    std::vector<std::string> arguments = GetParam().arguments;
    for (std::string& each : arguments) {
        if (each.starts_with("OUT")) each = folder_.file("out" + each.substr(3)).string();
        if (each == "STRANDS") each = writeStrands();
    }
    const fs::path scratch = folder_.file("scratch");
    fs::create_directory(scratch);
    setenv("TMPDIR", scratch.c_str(), 1);
    TerminalProcess process(arguments, folder_.file("stdout"));
    unsetenv("TMPDIR");
    ASSERT_TRUE(process.shows(GetParam().shown)) << process.shown();
    process.kill(GetParam().signal);
    EXPECT_LT(process.end(), kHeeded);
    EXPECT_EQ(process.status(), 130) << process.shown();
    EXPECT_THAT(process.shown(), testing::HasSubstr("interrupted"));
    EXPECT_TRUE(fs::is_empty(scratch));
    for (const auto& file : fs::directory_iterator(folder_.path()))
        EXPECT_NE(file.path().extension(), ".partial") << file.path();
}

const std::vector<std::string> kLargePicture{
    "--set", "/render/width=8192", "--set", "/render/height=8192"};

std::vector<std::string> ofLargePictures(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), kLargePicture.begin(), kLargePicture.end());
    return arguments;
}

INSTANTIATE_TEST_SUITE_P(
    , LongSteps,
    testing::Values(
        LongStep{
            "settling",
            {"simulate", scene("smoke.json"), "--no-cache", "--set",
             "/simulation/settle_steps=100000", "--set", "/groom/guides=2000", "--export",
             "OUT.hair"},
            "settles hair, step, [0-9]+ of 100000",
            SIGINT},
        LongStep{
            "growing",
            {"render", scene("portraits/layers.json"), "--set", "/groom/grow/strands=400000", "-o",
             "OUT.png"},
            "places roots|spreads roots",
            SIGTERM},
        LongStep{
            "baking",
            {"render", scene("distance_field.json"), "--no-cache", "--set",
             "/simulation/distance_fields/0/resolution=256", "-o", "OUT.png"},
            "bakes a distance field, block, [0-9]+ of",
            SIGINT},
        LongStep{
            "drawing", ofLargePictures({"render", scene("smoke.json"), "-o", "OUT.png"}),
            "draws frame 0", SIGTERM},
        LongStep{
            "planning",
            {"run", scene("portraits/layers.json"), "--set", "/groom/grow/strands=400000", "-o",
             "OUT.json"},
            "places roots|spreads roots",
            SIGINT},
        LongStep{
            "validating",
            {"validate", scene("portraits/layers.json"), scene("portraits/curls.json")},
            R"(\[1/2\].*(roots|strands))",
            SIGTERM},
        LongStep{
            "walking", ofLargePictures({"lod", scene("smoke.json"), "-o", "OUT.json"}),
            R"(\[[0-9]+/40\])", SIGINT},
        LongStep{
            "ablating", ofLargePictures({"ablate", scene("smoke.json"), "-o", "OUT.json"}),
            R"(\[1/2\])", SIGTERM},
        LongStep{
            "gating",
            ofLargePictures(
                {"gate", "--scene", scene("smoke.json"), "--a", HAIRBENCH_PROGRAM, "--b",
                 HAIRBENCH_PROGRAM, "-o", "OUT.json"}),
            "warm-up, A", SIGINT},
        LongStep{"checking", {"physics", "--out", "OUT.json"}, R"(\[[0-9]+/)", SIGTERM},
        LongStep{"examining", {"doctor"}, "examines the machine", SIGINT},
        LongStep{
            "exporting",
            {"export", scene("smoke.json"), "--mitsuba", "OUT", "--frame", "100000"},
            "frame [0-9]+",
            SIGTERM},
        LongStep{
            "comparing",
            {"groom", "compare", "STRANDS", "STRANDS", "--spacing", "0.05"},
            "finds strands in the second groom, [0-9]+ of",
            SIGTERM}),
    [](const auto& each) { return each.param.name; });

// The report has the first case, however long the second one's frame takes and however slow the
// machine is: LongSteps test the time.
TEST(InterruptedRun, HasTheCasesThatAreDone) {
    if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
    const TemporaryFolder folder;
    const fs::path out = folder.file("report.json");
    // With seed 1 the small picture comes first.
    const std::vector<std::string> arguments{"run",          scene("smoke.json"),
                                             "-a",           "/render/width=64,8192",
                                             "-a",           "/render/msaa=1",
                                             "--set",        "/render/height=8192",
                                             "--set",        "/strands/density=64",
                                             "--frames",     "2",
                                             "--warmup",     "2",
                                             "--order-seed", "1",
                                             "-o",           out.string()};
    TerminalProcess process(arguments, folder.file("stdout"));
    ASSERT_TRUE(process.shows("\\[2/2\\].*width:8192")) << process.shown();
    process.kill(SIGTERM);
    EXPECT_LT(process.end(), kPatience);
    EXPECT_EQ(process.status(), 130);
    EXPECT_THAT(process.shown(), testing::HasSubstr("interrupted after 1 of 2 cases"));
    const scene::Json report = report::readReport(out);
    EXPECT_EQ(report["interrupted"], true);
    ASSERT_EQ(report["cases"].size(), 1u);
    EXPECT_EQ(report["cases"][0]["status"], "ok");
    EXPECT_TRUE(fs::exists(out.string() + ".journal"));
}

// A run that ignores interrupts is killed and can't remove its own files.
TEST(InterruptedGate, LeavesNothingOfARunThatHadToBeKilled) {
    const TemporaryFolder folder;
    const fs::path scratch = folder.file("scratch");
    fs::create_directory(scratch);
    const fs::path stubborn = folder.file("stubborn.sh");
    std::ofstream(stubborn) << "trap '' INT TERM\ntouch \"$TMPDIR/left\"\nsleep 300\n";
    const auto left = [&] {
        const fs::recursive_directory_iterator files(scratch), end;
        return std::any_of(
            files, end, [](const auto& file) { return file.path().filename() == "left"; });
    };
    setenv("TMPDIR", scratch.c_str(), 1);
    TerminalProcess process(
        {"gate", "--scene", scene("smoke.json"), "--a", "sh '" + stubborn.string() + "'", "--b",
         HAIRBENCH_PROGRAM},
        folder.file("stdout"));
    unsetenv("TMPDIR");
    ASSERT_TRUE(process.shows("warm-up, A")) << process.shown();
    for (int i = 0; i < 1000 && !left(); ++i) usleep(10'000);
    ASSERT_TRUE(left());
    process.kill(SIGINT);
    EXPECT_LT(process.end(), kHeeded);
    EXPECT_EQ(process.status(), 130) << process.shown();
    EXPECT_TRUE(fs::is_empty(scratch));
}

}  // namespace
}  // namespace benchmarks::run
