// Tests a second driver. SwiftShader implements Vulkan with another compiler, and without
// tessellation, geometry stages, 64-bit integers, push descriptors and pipeline statistics.
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/pictures.h"
#include "tests/cli/run_hairbench.h"
#include "tests/flip_errors.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Makes the loader use only this driver.
std::string withDriver(const fs::path& icd) { return "VK_DRIVER_FILES='" + icd.string() + "' "; }

class SwiftShader : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(HAIRBENCH_SWIFTSHADER_ICD))
            return skipWithout(Need::swiftshader, "SwiftShader was not found by CMake");
        const Outcome outcome = run("devices");
        if (outcome.status != 0) return skipWithout(Need::swiftshader, outcome.output);
        ASSERT_THAT(outcome.output, HasSubstr("SwiftShader"));
    }

    static Outcome run(const std::string& arguments) {
        return hairbench(arguments, withDriver(HAIRBENCH_SWIFTSHADER_ICD));
    }

    nlohmann::json report(const std::string& arguments) {
        const fs::path out = folder_.path() / "report.json";
        const Outcome outcome = run(arguments + " --out '" + out.string() + "'");
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return nlohmann::json::parse(textOf(out));
    }

    TemporaryFolder folder_;
};

TEST_F(SwiftShader, IsListedWithWhatItLacks) {
    const std::string output = run("devices").output;
    EXPECT_THAT(output, HasSubstr("runs hairbench"));
    for (const char* lacking :
         {"tessellation stages with isolines", "geometry stages", "pipeline statistics"})
        EXPECT_THAT(output, HasSubstr(std::string("\n     ") + lacking));
}

TEST_F(SwiftShader, SkipsStrandsWithTheirReason) {
    const nlohmann::json found = report(
        "run " + shippedScene("smoke.json") +
        "-a /strands/backend=tessellation,pulling_geometry -a /render/hair=true,false "
        "--frames 1 --warmup 2 --max-time 0");
    for (const nlohmann::json& each : found["cases"]) {
        const bool hair = each["axes"]["/render/hair"].get<bool>();
        EXPECT_EQ(each["status"], hair ? "skipped" : "ok") << each;
        if (!hair) continue;
        EXPECT_THAT(
            each["reason"].get<std::string>(),
            testing::MatchesRegex("/strands/backend: [a-z_]+: the device has no [a-z ]+"));
    }
}

// Tests back ends that need none of the missing stages. By rounding, edges of strands fall on
// either side of a sample, and the shading of steep strands differs. The test draws a quarter of
// the scene's strands, because drawing them takes most of SwiftShader's time. Their error is about
// 0.0066; that of all strands is 0.008.
TEST_F(SwiftShader, DrawsStrandsAsTheOtherDeviceDoes) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    if (hairbench("devices").status != 0) return skipWithout(Need::device, "no other device");
    // SwiftShader compiles every pipeline anew for each of these. The two back ends that draw quads
    // share their rasteriser, so one sample and four are enough once each.
    const std::pair<std::string, std::string> drawn[] = {
        {"software", "1"}, {"software", "4"}, {"pulling", "4"}, {"expanded", "1"}};
    for (const auto& [backend, samples] : drawn) {
        const auto draw = [&](const std::string& name, bool here) {
            const fs::path picture = folder_.path() / (name + backend + samples + ".png");
            const std::string arguments =
                "render " + shippedScene("rest.json") + "--set /strands/backend=" + backend +
                " --set /strands/density=16 --set /render/width=640 --set /render/height=360"
                " --set /render/ssaa=1"
                " --set /render/msaa=" +
                samples + " --set /simulation/solver=none --frame 1 -o '" + picture.string() + "'";
            const Outcome outcome = here ? run(arguments) : hairbench(arguments);
            EXPECT_EQ(outcome.status, 0) << outcome.output;
            return picture;
        };
        // A rasteriser chooses the place in a quad at which it shades a pixel with several samples
        // (Vulkan specification, "Centroid"). `software` shades every sample.
        const bool is_chosen = samples != "1" && backend != "software";
        EXPECT_LE(
            flipErrors({{draw("there", false), draw("here", true)}})[0],
            is_chosen ? 0.0125 : 0.0085)
            << backend << " " << samples;
    }
}

TEST_F(SwiftShader, MeasuresTheSimulation) {
    const nlohmann::json found = report(
        "run " + shippedScene("simulation_scale.json") +
        "--filter 'guides:(86|1000)/vertices:8/' "
        "--max-time 0");
    ASSERT_EQ(found["cases"].size(), 4u);
    for (const nlohmann::json& each : found["cases"]) EXPECT_EQ(each["status"], "ok") << each;
}

TEST_F(SwiftShader, PassesThePhysicsOfEverySolver) {
    const fs::path out = folder_.path() / "physics.json";
    const Outcome outcome = run(
        "physics --check 'free_fall|projectile|state_hash|energy' --out '" + out.string() + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

// Returns the number of pixels with different colours.
std::size_t differing(const engine::Pixels& a, const engine::Pixels& b) {
    if (a.rgba.size() != b.rgba.size() || a.rgba.empty())
        throw std::invalid_argument("pictures of different sizes");
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
        count += !std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]);
    return count;
}

// Guides are quads of one colour. A device may round their corners to sixteenths of a pixel, so an
// edge is up to 1/32 pixel off, and the same share of the pixels along it falls on its other side.
// Quads a pixel wide have two edges per pixel, and there are two devices: 1/8.
TEST_F(SwiftShader, DrawsTheGuidesAsTheOtherDeviceDoes) {
    const auto draw = [&](const std::string& name, const std::string& guides, bool here) {
        const fs::path picture = folder_.path() / name;
        const std::string arguments = "render " + shippedScene("guides_overlay.json") +
                                      "--set /render/overlays/guides=" + guides +
                                      " --set /render/hair=false --set /render/head=false "
                                      "--set /simulation/solver=none --frame 1 -o '" +
                                      picture.string() + "'";
        const Outcome outcome = here ? run(arguments) : hairbench(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return engine::readImage(picture);
    };
    if (hairbench("devices").status != 0) return skipWithout(Need::device, "no other device");
    const engine::Pixels here = draw("here.png", "true", true);
    const engine::Pixels empty = draw("empty.png", "false", true);
    const std::size_t guides = differing(here, empty);
    // There are 86 guides. Each is longer than a tenth of the picture's 720 rows and at least a
    // pixel wide. Two of three may be hidden by others.
    EXPECT_GT(guides, 86u * 72u / 3u);
    EXPECT_LT(differing(here, draw("there.png", "true", false)), guides / 8);
}

// The loader hides drivers of a subset of Vulkan from programs that don't ask for them.
TEST_F(SwiftShader, IsFoundWhereItSaysThatItIsASubset) {
    nlohmann::json description = nlohmann::json::parse(textOf(HAIRBENCH_SWIFTSHADER_ICD));
    description["ICD"]["is_portability_driver"] = true;
    const Outcome outcome =
        hairbench("devices", withDriver(folder_.write("subset.json", description.dump())));
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("SwiftShader"));
}

}  // namespace
