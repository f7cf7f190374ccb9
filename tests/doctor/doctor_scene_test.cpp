#include "benchmarks/doctor/facts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "hair/rendering/backends.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::doctor {
namespace {

using testing::Each;
using testing::Gt;

TEST(DoctorStrands, HangWithTheirLengthFromADisc) {
    const hair::groom::StrandSet strands = doctorStrands();
    ASSERT_GT(strands.strandCount(), 0u);
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i) {
        const auto points = strands.strand(i);
        ASSERT_EQ(points.size(), 8u);
        EXPECT_LE(std::hypot(points[0].x, points[0].z), 0.08f);
        double length = 0.0;
        for (std::size_t j = 1; j < points.size(); ++j) {
            EXPECT_LT(points[j].y, points[j - 1].y);
            length += std::hypot(
                points[j].x - points[j - 1].x, points[j].y - points[j - 1].y,
                points[j].z - points[j - 1].z);
        }
        EXPECT_NEAR(length, 0.2, 1e-6);  // seven sums of float coordinates below 0.2
    }
}

TEST(DoctorScene, IsASceneFileLikeAnyOther) {
    const TemporaryFolder folder;
    const std::filesystem::path path = writeDoctorScene(folder.path());
    const scene::Scene scene = scene::loadScene(path);
    EXPECT_EQ(scene::writeSettings(scene.settings), scene::writeSettings(doctorSettings()));
    EXPECT_EQ(scene::expand(scene).size(), 1u);
}

using DoctorSceneTest = GpuTest;

TEST_F(DoctorSceneTest, ShowsMovingHairInEveryPassOfTheFrame) {
    const TemporaryFolder folder;
    writeDoctorScene(folder.path());
    measure::Case test_case(device(), doctorSettings(), folder.path());
    engine::FrameLoop loop(device(), engine::Timing::isolated);
    const auto draw = [&] { loop.frame([&](engine::Passes& passes) { test_case.frame(passes); }); };
    draw();
    const std::vector<engine::FrameRecord> frames = loop.finish();
    std::vector<std::string> passes{"wind", "simulate", "scene", "strands"};
    hair::Settings drawn = doctorSettings();
    drawn.strands.backend = test_case.backend().value().backend;
    if (hair::rendering::readsPoints(drawn)) passes.insert(passes.begin() + 3, "points");
    EXPECT_EQ(measure::passNames(frames), passes);
    const std::string state = test_case.stateHash();

    // Pixels that differ from the corner, which is background, are hair.
    const std::vector<std::uint8_t> pixels = test_case.picture();
    std::size_t hair = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 4)
        hair += !std::equal(
            pixels.begin(), pixels.begin() + 3, pixels.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_GT(hair, pixels.size() / 4 / 20);
    EXPECT_LT(hair, pixels.size() / 4 / 2);
    draw();
    loop.finish();
    EXPECT_NE(test_case.stateHash(), state);
}

}  // namespace
}  // namespace benchmarks::doctor
