#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "engine/pictures.h"
#include "tests/flip_errors.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

// Compares pictures of features with golden ones that people have looked at. See
// tests/golden/README.md.
namespace hair {
namespace {

namespace fs = std::filesystem;

// Mean FLIP error. Software pictures are the same in every run. Between versions of Mesa, rounding
// moves a few edges over a sample. One pixel of another colour in 160 x 128 is 5e-5, which FLIP's
// filters spread to about 2e-4. So this allows ten such pixels.
constexpr double kTolerance = 0.002;

fs::path goldenPicture(const std::string& name) {
    return fs::path(HAIRBENCH_SOURCE_DIR "/tests/golden/pictures") / (name + ".png");
}

class GoldenTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        if (device().info().driver_id != VK_DRIVER_ID_MESA_LLVMPIPE)
            GTEST_SKIP() << "the pictures are lavapipe's";
        if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    }
};

// The drawn pictures stay in golden/ beside the program, wherever it was started. One can look at
// them, and take them over as golden pictures after an intended change.
TEST_F(GoldenTest, FeaturesLookAsTheyDid) {
    const fs::path drawn = HAIRBENCH_DRAWN_DIR;
    std::vector<std::pair<fs::path, fs::path>> pairs;
    for (const Feature& feature : features()) {
        Settings settings = plainSettings();
        feature.show(settings);
        const fs::path path = drawn / (std::string(feature.name) + ".png");
        engine::writePng(
            path, settings.render.width, settings.render.height,
            rendering::drawCase(device(), settings));
        for (const std::string& message : device().messages().take())
            ADD_FAILURE() << feature.name << ": " << message;
        if (fs::exists(goldenPicture(feature.name)))
            pairs.emplace_back(goldenPicture(feature.name), path);
        else
            ADD_FAILURE() << path << " has no golden picture";
    }
    const std::vector<double> figures = flipErrors(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        EXPECT_LE(figures[i], kTolerance) << "see " << pairs[i].second;
}

// A golden picture that looks the same without its feature would test nothing.
TEST_F(GoldenTest, FeaturesAreSeen) {
    std::vector<std::pair<fs::path, fs::path>> pairs;
    std::vector<const char*> names;
    for (const Feature& feature : features()) {
        if (!feature.differs_from) continue;
        pairs.emplace_back(goldenPicture(feature.differs_from), goldenPicture(feature.name));
        names.push_back(feature.name);
    }
    const std::vector<double> figures = flipErrors(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        EXPECT_GT(figures[i], 3 * kTolerance) << names[i];
}

TEST_F(GoldenTest, ToleranceIsSmallerThanAShiftByAPixel) {
    const engine::Pixels golden = engine::readImage(goldenPicture("plain"));
    std::vector<std::uint8_t> shifted = golden.rgba;
    std::rotate(shifted.begin(), shifted.begin() + 4, shifted.end());
    const TemporaryFolder folder;
    engine::writePng(folder.path() / "shifted.png", golden.width, golden.height, shifted);
    EXPECT_GT(
        flipErrors({{goldenPicture("plain"), folder.path() / "shifted.png"}})[0], 3 * kTolerance);
}

}  // namespace
}  // namespace hair
