// Tests `hairbench render` of one frame and of several, as a user runs it.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SequenceCli : public testing::Test {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
    }

    std::string quoted(std::string_view name) const {
        return "'" + folder_.file(name).string() + "'";
    }
    static std::string smallSmoke() {
        return "render '" HAIRBENCH_SCENES_DIR "/smoke.json' -a /render/width=64"
               " -a /render/height=64 ";
    }

    TemporaryFolder folder_;
};

TEST_F(SequenceCli, WritesEveryFrameAsItIsByItself) {
    const Outcome outcome = hairbench(smallSmoke() + "--frames 1:6:2 -o " + quoted("out/%03d.png"));
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, testing::Not(HasSubstr("[3/3]")));  // no terminal, no progress
    EXPECT_THAT(outcome.output, HasSubstr("3 pictures, frames 1 to 5 of smoke"));
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.file("out")))
        names.push_back(entry.path().filename().string());
    EXPECT_THAT(names, testing::UnorderedElementsAre("001.png", "003.png", "005.png"));
    EXPECT_EQ(hairbench(smallSmoke() + "--frame 5 -o " + quoted("five.png")).status, 0);
    EXPECT_EQ(textOf(folder_.file("five.png")), textOf(folder_.file("out/005.png")));
    EXPECT_NE(textOf(folder_.file("five.png")), textOf(folder_.file("out/001.png")));
}

// Every strand is at least a pixel wide, so thousands of them give more than one fragment per
// pixel.
TEST_F(SequenceCli, SaysWhatListsOfFragmentsHaveNoRoomFor) {
    const std::string lists = "-a /render/coverage=analytic -a /strands/density=64 "
                              "-a /render/transparency=fragment_list -a /render/list_length=";
    const Outcome short_lists = hairbench(smallSmoke() + lists + "1 -o " + quoted("short.png"));
    EXPECT_EQ(short_lists.status, 0) << short_lists.output;
    EXPECT_THAT(short_lists.output, HasSubstr("fragments did not fit /render/list_length"));
    const Outcome long_lists = hairbench(smallSmoke() + lists + "256 -o " + quoted("long.png"));
    EXPECT_THAT(long_lists.output, testing::Not(HasSubstr("did not fit")));
}

// An OpenEXR file begins with its magic number, 20000630.
TEST_F(SequenceCli, WritesLinearLightAsExr) {
    for (const char* options : {"", "-a '/render/tone_map=\"agx\"' "}) {
        const Outcome outcome = hairbench(smallSmoke() + options + "-o " + quoted("a.exr"));
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(textOf(folder_.file("a.exr")).substr(0, 4), "\x76\x2f\x31\x01");
    }
}

TEST_F(SequenceCli, RefusesWhatHasNoPlaceBeforeItBegins) {
    for (const std::string& arguments :
         {"--frames 0:3 -o " + quoted("out/same.png"), "--frames 0:3 -o " + quoted("%d%d.png"),
          "--frames 3:3 -o " + quoted("%d.png"), "--frames 0:3 -o " + quoted("%d.jpg"),
          "--frames 0:3 --frame 2 -o " + quoted("%d.png")}) {
        const Outcome outcome = hairbench(smallSmoke() + arguments);
        EXPECT_EQ(outcome.status, 2) << arguments << outcome.output;
    }
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

// Without job control the shell's children would ignore the interrupt.
TEST_F(SequenceCli, KeepsWholePicturesWhenItIsInterrupted) {
    const std::string log = quoted("log");
    const fs::path script = folder_.write(
        "interrupt.sh", "set -m\n'" HAIRBENCH_PROGRAM "' " + smallSmoke() +
                            "--frames 0:1000000 -o " + quoted("out/%d.png") + " >" + log +
                            " 2>&1 &\nfor i in $(seq 600); do test -e " + quoted("out/1.png") +
                            " && break; sleep 0.1; done\nkill -INT $!\nwait $!\n");
    EXPECT_EQ(runInShell("bash '" + script.string() + "'").status, 130);
    EXPECT_THAT(textOf(folder_.file("log")), HasSubstr(" of 1000000 pictures are written\n"));
    EXPECT_TRUE(fs::exists(folder_.file("out/1.png")));
    for (const auto& entry : fs::directory_iterator(folder_.file("out")))
        EXPECT_EQ(entry.path().extension(), ".png");
}

// Each case plays 300 frames, so that the interrupt finds a case that is not finished.
TEST_F(SequenceCli, ContinuesASweepThatWasInterrupted) {
    const std::string options = smallSmoke() +
                                "-a /render/msaa=1 -a /simulation/wind/strength=0,2,5 "
                                "--frame 300 -o " +
                                quoted("{case}.png");
    const std::string name = "msaa-1_width-64_height-64_strength-";
    const std::string first = name + "0.png";
    const fs::path script = folder_.write(
        "interrupt.sh", "set -m\n'" HAIRBENCH_PROGRAM "' " + options + " >" + quoted("log") +
                            " 2>&1 &\nfor i in $(seq 1200); do test -e " + quoted(first) +
                            " && break; sleep 0.05; done\nkill -INT $!\nwait $!\n");
    EXPECT_EQ(runInShell("bash '" + script.string() + "'").status, 130);
    EXPECT_THAT(
        textOf(folder_.file("log")), HasSubstr(" of 3 pictures are written; --resume continues\n"));
    ASSERT_TRUE(fs::exists(folder_.file("smoke.png.journal")));
    folder_.write(first, "kept");
    const Outcome resumed = hairbench(options + " --resume");
    EXPECT_EQ(resumed.status, 0) << resumed.output;
    EXPECT_THAT(resumed.output, HasSubstr(" of 3 cases are there already"));
    EXPECT_EQ(textOf(folder_.file(first)), "kept");
    EXPECT_TRUE(fs::exists(folder_.file(name + "5.png")));
    EXPECT_FALSE(fs::exists(folder_.file("smoke.png.journal")));
}

}  // namespace
