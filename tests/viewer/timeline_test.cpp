#include "benchmarks/viewer/open_scene.h"

#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

// Frames of 1/4 s: frame 0 ends at 0.25 s, frame 3 at 1 s.
hair::Settings quarters() {
    hair::Settings settings;
    settings.run.frame_time = 0.25f;
    settings.simulation.motion.keyframes = {{.time = 0.25f}, {.time = 1.0f}};
    settings.simulation.pulls.resize(2);
    settings.simulation.pulls[1].path = {{0.5f, {}}, {5.0f, {}}};
    return settings;
}

TEST(Timeline, HasKeyframesAndPulls) {
    const std::vector<TimelineMark> marks = timelineMarks(quarters());
    ASSERT_EQ(marks.size(), 3u);  // a hand without a path does not pull
    EXPECT_EQ(marks[0].kind, TimelineMark::Kind::keyframe);
    EXPECT_EQ(marks[0].from, 0.0f);
    EXPECT_EQ(marks[1].from, 3.0f);
    EXPECT_EQ(marks[2].kind, TimelineMark::Kind::pull);
    EXPECT_EQ(marks[2].from, 1.0f);
    EXPECT_EQ(marks[2].to, 19.0f);
}

TEST(Timeline, EndsAfterAllThatHappens) {
    hair::Settings settings = quarters();
    EXPECT_EQ(timelineEnd(settings, 2, 5), 19u);
    EXPECT_EQ(timelineEnd(settings, 2, 30), 30u);
    EXPECT_EQ(timelineEnd(settings, 40, 30), 40u);
    settings.simulation.pulls.clear();
    EXPECT_EQ(timelineEnd(settings, 0, 0), 7u);  // 2 s
    settings.run.frame_time = 0.0f;
    EXPECT_TRUE(timelineMarks(settings).empty());
    EXPECT_EQ(timelineEnd(settings, 0, 0), 1u);
}

}  // namespace
}  // namespace benchmarks::viewer
