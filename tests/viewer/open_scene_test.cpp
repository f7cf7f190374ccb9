#include "benchmarks/viewer/open_scene.h"

#include <exception>
#include <utility>

#include <gtest/gtest.h>

#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"

namespace benchmarks::viewer {
namespace {

SceneFile fileOf(const hair::Settings& settings) {
    return {
        .path = "made_up.json",
        .directory = HAIRBENCH_SCENES_DIR,
        .name = "made_up",
        .settings = settings};
}

class OpenScenes : public GpuTest {
protected:
    OpenScenes() : studio(device(), "no shaders are watched") { turn(); }

    // Gives the wanted order and takes its replies.
    OpenScene::News
    turn(double seconds = 0.0, OpenScene::Frames frames = OpenScene::Frames::as_due) {
        PlayState still{.playing = false};
        PlayState& wanted = scene.isMaking() ? still : state;
        Reply reply = studio.perform(scene.order(wanted, seconds, frames), [] { return false; });
        return scene.take(std::move(reply.sides), Side::Beside::nothing);
    }
    void play(int pictures) {
        for (int i = 0; i < pictures; ++i) turn();
    }
    hair::Settings denser(std::size_t side) {
        hair::Settings settings = scene.side(side).wanted();
        settings.strands.density += 1;
        return settings;
    }
    void edit(std::size_t side, const hair::Settings& settings) {
        scene.edit(side, settings, {.changed = true});
    }
    void compare() {
        scene.startComparing();
        EXPECT_EQ(scene.sideCount(), 1u);  // until its picture exists
        EXPECT_TRUE(turn().compares);
    }

    Studio studio;
    OpenScene scene{fileOf(hair::plainSettings()), hair::plainSettings()};
    PlayState state;
};

TEST_F(OpenScenes, PlayStepAndSeek) {
    play(3);
    EXPECT_EQ(scene.side(0).shown().frame, 3u);
    state.playing = false;
    play(2);
    EXPECT_EQ(scene.side(0).shown().frame, 3u);
    state.step = true;
    play(2);
    EXPECT_EQ(scene.side(0).shown().frame, 4u);
    state.seek = 1;
    play(2);
    EXPECT_EQ(scene.side(0).shown().frame, 1u);
}

TEST_F(OpenScenes, TimeFramesInTurnsBothWays) {
    play(6);
    EXPECT_EQ(scene.side(0).timings().isolated().size(), 3u);
    EXPECT_EQ(scene.side(0).timings().overlapped().size(), 3u);
}

TEST_F(OpenScenes, PlayEveryFrameForARecording) {
    state.speed = 4.0;
    const double second = 1.0;
    turn(second, OpenScene::Frames::every_one);
    EXPECT_EQ(scene.side(0).shown().frame, 1u);
}

TEST_F(OpenScenes, CompareFromTheFrameAndSettingsThatAreThere) {
    edit(0, denser(0));
    play(2);
    compare();
    ASSERT_EQ(scene.sideCount(), 2u);
    EXPECT_EQ(scene.edited(), 1u);
    EXPECT_EQ(scene.side(1).shown().frame, 2u);
    EXPECT_EQ(scene.side(1).shown().pictureHash(), scene.side(0).shown().pictureHash());
    play(1);
    EXPECT_EQ(scene.side(1).shown().frame, scene.side(0).shown().frame);
}

TEST_F(OpenScenes, CompareASettingOfEachSide) {
    compare();
    edit(1, denser(1));
    EXPECT_NE(scene.side(1).wanted().strands.density, scene.side(0).wanted().strands.density);
    // The second side's settings are compared with the first side's.
    EXPECT_EQ(scene.reference().strands.density, scene.side(0).wanted().strands.density);
    const std::uint32_t b = scene.side(1).wanted().strands.density;
    scene.swapSides();
    EXPECT_EQ(scene.side(0).wanted().strands.density, b);
    scene.stopComparing();
    EXPECT_EQ(scene.sideCount(), 1u);
    EXPECT_EQ(scene.editedSide().wanted().strands.density, b);
}

TEST_F(OpenScenes, MoveBothCamerasWhileTheyAreLinked) {
    compare();
    hair::Settings settings = denser(1);
    settings.camera.position.x += 0.125f;
    edit(1, settings);
    EXPECT_EQ(scene.side(0).wanted().camera.position, settings.camera.position);
    EXPECT_NE(scene.side(0).wanted().strands.density, settings.strands.density);
    scene.cameras = Cameras::separate;
    settings.camera.position.x += 0.125f;
    edit(1, settings);
    EXPECT_NE(scene.side(0).wanted().camera.position, settings.camera.position);
}

TEST_F(OpenScenes, ReplaceEachOther) {
    compare();
    play(2);
    hair::Settings other = hair::plainSettings();
    other.strands.density = 3;
    SceneFile file = fileOf(other);
    file.name = "other";
    scene.open(file);
    EXPECT_EQ(scene.file().name, "made_up");  // until the first picture exists
    EXPECT_TRUE(turn().opened);
    EXPECT_EQ(scene.sideCount(), 1u);
    EXPECT_EQ(scene.edited(), 0u);
    EXPECT_EQ(scene.file().name, "other");
    EXPECT_EQ(scene.side(0).shown().frame, 0u);
    EXPECT_EQ(scene.side(0).shown().settings.strands.density, 3u);
}

TEST_F(OpenScenes, StayWhereAnotherCantBeOpened) {
    play(2);
    hair::Settings broken = hair::plainSettings();
    broken.groom.file = "there is no such file.hair";
    scene.open(fileOf(broken));
    const OpenScene::News news = turn();
    ASSERT_TRUE(news.failure);
    EXPECT_THROW(std::rethrow_exception(news.failure), engine::Error);
    EXPECT_FALSE(news.opened);
    EXPECT_EQ(scene.file().settings.groom.file, hair::plainSettings().groom.file);
    EXPECT_EQ(scene.side(0).shown().frame, 2u);
}

TEST_F(OpenScenes, AreMarkedAgainstWhatIsOnDisk) {
    edit(0, denser(0));
    EXPECT_NE(scene.reference().strands.density, scene.side(0).wanted().strands.density);
    scene.savedAs("elsewhere/saved.json", scene.side(0).wanted());
    EXPECT_EQ(scene.reference().strands.density, scene.side(0).wanted().strands.density);
    EXPECT_EQ(scene.file().name, "saved");
    EXPECT_TRUE(scene.wasSaved());
}

}  // namespace
}  // namespace benchmarks::viewer
