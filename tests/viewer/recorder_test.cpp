#include "benchmarks/viewer/recorder.h"

#include <gmock/gmock.h>

#include "engine/pictures.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

using testing::HasSubstr;

class RecorderTest : public GpuTest {
protected:
    // A small picture with moving hair.
    static hair::Settings settings() {
        hair::Settings settings;
        settings.groom.guides = 10;
        settings.strands.density = 4;
        settings.render.width = 48;
        settings.render.height = 32;
        settings.simulation.wind.strength = 0.5f;
        return settings;
    }

    static Player player() { return Player(device(), settings(), HAIRBENCH_SCENES_DIR); }

    TemporaryFolder folder_;
};

TEST_F(RecorderTest, WritesEachShownFrameOnce) {
    Player shown = player();
    Recorder recorder;
    recorder.frame(shown.shown());
    EXPECT_FALSE(recorder.records());
    EXPECT_EQ(recorder.message(), "");
    const auto place = folder_.file("new/take");
    recorder.start(place);
    EXPECT_EQ(recorder.message(), "recording 0 frames to " + place.string());
    std::vector<std::vector<std::uint8_t>> expected;
    for (int i = 0; i < 3; ++i) {
        expected.push_back(shown.played().picture());
        recorder.frame(shown.shown());
        recorder.frame(shown.shown());  // the window is drawn more often than the hair
        if (i == 0) {
            EXPECT_EQ(recorder.message(), "recording 1 frame to " + place.string());
        }
        shown.next();
    }
    EXPECT_EQ(recorder.written(), 3u);
    recorder.stop();
    recorder.frame(shown.shown());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto file = place / ("000" + std::to_string(i) + ".png");
        EXPECT_EQ(engine::readImage(file).rgba, expected[i]) << i;
    }
    EXPECT_FALSE(std::filesystem::exists(place / "0003.png"));
}

TEST_F(RecorderTest, LeavesAnotherRecordingAlone) {
    folder_.write("take/0000.png", "mine");
    Recorder recorder;
    EXPECT_EQ(
        folder_.relative(errorText([&] { recorder.start(folder_.file("take")); })),
        "take: has a recording already");
    EXPECT_FALSE(recorder.records());
    EXPECT_EQ(textOf(folder_.file("take/0000.png")), "mine");
}

TEST_F(RecorderTest, SaysWhereNoFolderCanBeMade) {
    folder_.write("file", "");
    Recorder recorder;
    EXPECT_THAT(
        errorText([&] { recorder.start(folder_.file("file/take")); }),
        HasSubstr(folder_.file("file").string()));
    EXPECT_FALSE(recorder.records());
}

TEST_F(RecorderTest, StopsWhereAPictureCannotBeWritten) {
    Player shown = player();
    Recorder recorder;
    recorder.start(folder_.file("take"));
    recorder.frame(shown.shown());
    std::filesystem::remove_all(folder_.file("take"));
    folder_.write("take", "in the way");
    shown.next();
    EXPECT_THAT(
        errorText([&] { recorder.frame(shown.shown()); }),
        HasSubstr(folder_.file("take").string()));
    EXPECT_FALSE(recorder.records());
    recorder.frame(shown.shown());
}

}  // namespace
}  // namespace benchmarks::viewer
