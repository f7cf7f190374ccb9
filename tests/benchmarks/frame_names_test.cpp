#include "benchmarks/scene/pattern.h"

#include <gmock/gmock.h>

#include "tests/error_text.h"

namespace benchmarks {
namespace {

using testing::StartsWith;

TEST(FrameRange, LeavesOutItsEnd) {
    const scene::FrameRange range = scene::parseFrameRange("2:5");
    EXPECT_EQ(range.count(), 3u);
    EXPECT_FALSE(range.holds(1));
    EXPECT_TRUE(range.holds(2));
    EXPECT_TRUE(range.holds(4));
    EXPECT_FALSE(range.holds(5));
}

TEST(FrameRange, TakesSteps) {
    const scene::FrameRange range = scene::parseFrameRange("0:10:4");  // 0, 4, 8
    EXPECT_EQ(range.count(), 3u);
    EXPECT_TRUE(range.holds(8));
    EXPECT_FALSE(range.holds(2));
    EXPECT_EQ(scene::parseFrameRange("0:9:4").count(), 3u);
    EXPECT_EQ(scene::parseFrameRange("0:8:4").count(), 2u);
}

TEST(FrameRange, RefusesWhatIsNone) {
    for (const char* text :
         {"", "5", ":", "1:", ":3", "3:3", "4:2", "0:4:0", "0:4:1:1", "-1:3", "a:b", "0:1000001",
          "0:99999999999", "0:4 "})
        EXPECT_THAT(
            errorText([&] { scene::parseFrameRange(text); }),
            StartsWith("--frames " + std::string(text) + ": "));
}

TEST(FramePaths, PutTheNumberInItsPlace) {
    EXPECT_EQ(scene::FramePaths("out/%04d.png").of(7), "out/0007.png");
    EXPECT_EQ(scene::FramePaths("out/%04d.png").of(123456), "out/123456.png");
    EXPECT_EQ(scene::FramePaths("a%d").of(12), "a12");
    EXPECT_EQ(scene::FramePaths("100%%/%02d.exr").of(3), "100%/03.exr");
    EXPECT_TRUE(scene::FramePaths("%d").hasNumber());
    EXPECT_FALSE(scene::FramePaths("a%%d.png").hasNumber());
    EXPECT_EQ(scene::FramePaths("a%%d.png").of(3), "a%d.png");
}

TEST(FramePaths, RefuseOtherPatterns) {
    for (const char* text : {"%d%d.png", "%s.png", "%", "%4d.png", "%04", "%0d", "%012d", "%ld"})
        EXPECT_THAT(
            errorText([&] { scene::FramePaths{text}; }), StartsWith(std::string(text) + ": "));
}

}  // namespace
}  // namespace benchmarks
