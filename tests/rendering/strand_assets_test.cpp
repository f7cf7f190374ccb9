#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

// Tests that data which a scene's strands need and its files lack cause errors before anything
// runs.
namespace benchmarks {
namespace {

hair::Settings grown() {
    hair::Settings settings;
    settings.groom.grow.mesh = HAIRBENCH_SCENES_DIR "/assets/head.glb";
    return settings;
}

std::string errorOf(const hair::Settings& settings) {
    const TemporaryFolder folder;
    const auto scene = folder.write("s.json", "{}");
    return folder.relative(errorText([&] { scene::checkAssets(settings, scene); }));
}

TEST(StrandAssets, RefuseWidthsThatTheGroomLacks) {
    hair::Settings settings = grown();
    settings.strands.width = hair::WidthSource::groom;
    EXPECT_EQ(errorOf(settings), "s.json: /strands/width: is groom, but the groom has no widths");
}

TEST(StrandAssets, RefuseStrandsThatTheGroomLacks) {
    hair::Settings settings = grown();
    settings.strands.source = hair::StrandSource::groom;
    EXPECT_EQ(
        errorOf(settings), "s.json: /strands/source: is groom, but the groom has no bindings");
}

// 0.15 m long.
TEST(StrandAssets, RefuseMoreTurnsThanOffsetsHold) {
    hair::Settings settings = grown();
    settings.strands.curl = {.radius = 0.001f, .frequency = 9000.0f, .frequency_variation = 0.0f};
    EXPECT_EQ(
        errorOf(settings), "s.json: /strands/curl/frequency: makes 1350 turns on a strand; offsets "
                           "can have at most 1024");
}

TEST(StrandAssets, NameAMissingFileOfOffsets) {
    hair::Settings settings = grown();
    settings.strands.offsets = "none.hgl";
    EXPECT_EQ(errorOf(settings).substr(0, 10), "none.hgl: ");
}

}  // namespace
}  // namespace benchmarks
