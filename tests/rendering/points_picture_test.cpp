#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include <gtest/gtest.h>

#include "benchmarks/scene/scene.h"
#include "engine/pictures.h"
#include "tests/flip_errors.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"
#include "tests/required.h"

// Pictures by back ends that draw from points in memory, compared with those of `tessellation`,
// which draws the same quads in another way.
namespace hair::rendering {
namespace {

namespace fs = std::filesystem;

struct Way {
    const char* name;
    Backend backend;
    // Greatest mean FLIP error of pictures that look the same. Points keep tangents to 0.1 degrees
    // and widths to 0.4 %. Differently rounded quads put edges on other sides of samples.
    // `software` also shades each of a pixel's samples separately.
    double most_different;
};

constexpr std::array kWays{
    Way{"expanded", Backend::expanded, 0.005}, Way{"software", Backend::software, 0.02}};

// The differences of two pictures, in steps of a channel.
std::vector<int> channelDifferences(const Pixels& a, const Pixels& b) {
    if (a.size() != b.size() || a.empty()) throw std::invalid_argument("pictures of other sizes");
    std::vector<int> differences;
    for (std::size_t i = 0; i < a.size(); ++i)
        differences.push_back(std::abs(int{a[i]} - int{b[i]}));
    return differences;
}

class PointsPicture : public GpuTest {
protected:
    // A case after some frames, in which the simulation moves the hair.
    class Played {
    public:
        Played(
            const engine::Device& device, const Settings& settings, int frames,
            const fs::path& folder = HAIRBENCH_SCENES_DIR)
            : case_(device, settings, folder), loop_(device, engine::Timing::overlapped) {
            for (int i = 0; i < frames; ++i)
                loop_.frame([&](engine::Passes& passes) { case_.frame(passes); });
            loop_.finish();
        }

        // The case's last frame, drawn with these settings.
        Pixels drawn(const Settings& settings) {
            case_.setDrawing(settings);
            loop_.frame([&](engine::Passes& passes) { case_.draw(passes); });
            loop_.finish();
            return case_.picture();
        }

    private:
        benchmarks::measure::Case case_;
        engine::FrameLoop loop_;
    };

    // A shipped scene, less settled. All back ends draw the maps of hair's shadows alike, so it has
    // none.
    static Settings sceneOf(const std::string& name, std::uint32_t samples) {
        Settings settings =
            benchmarks::scene::loadScene(fs::path(HAIRBENCH_SCENES_DIR) / (name + ".json"))
                .settings;
        settings.simulation.settle_steps = std::min(settings.simulation.settle_steps, 30u);
        settings.shading.shadows.hair = HairShadows::none;
        settings.render.ssaa = 1;
        settings.render.msaa = samples;
        return settings;
    }

    fs::path write(const std::string& name, const Settings& settings, const Pixels& pixels) {
        return writePicture(folder_.path() / (name + ".png"), settings, pixels);
    }

    TemporaryFolder folder_;
};

TEST_F(PointsPicture, IsThatOfTessellation) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    std::vector<std::pair<fs::path, fs::path>> pairs;
    std::vector<std::pair<std::string, double>> expectations;
    for (const char* scene :
         {"rest", "strong_wind", "curly", "root_triangles/tight_curls", "lod_path"}) {
        const fs::path file = fs::path(HAIRBENCH_SCENES_DIR) / scene;
        Played played(
            device(), with(sceneOf(scene, 1), Backend::tessellation), 3, file.parent_path());
        for (const std::uint32_t samples : {1u, 4u}) {
            const Settings settings = sceneOf(scene, samples);
            const std::string name = file.filename().string() + " " + std::to_string(samples);
            const Pixels expected = played.drawn(with(settings, Backend::tessellation));
            const fs::path expected_path = write(name + " t", settings, expected);
            Settings bald = with(settings, Backend::tessellation);
            bald.render.hair = false;
            EXPECT_GT(differingPixels(expected, played.drawn(bald)), 1280u * 720u / 20u) << name;
            for (const Way& way : kWays) {
                const std::string drawn = name + " " + way.name;
                expectations.emplace_back(drawn, way.most_different);
                pairs.emplace_back(
                    expected_path,
                    write(drawn, settings, played.drawn(with(settings, way.backend))));
            }
        }
    }
    const std::vector<double> errors = flipErrors(pairs);
    ASSERT_EQ(errors.size(), expectations.size());
    for (std::size_t i = 0; i < errors.size(); ++i)
        EXPECT_LE(errors[i], expectations[i].second) << expectations[i].first;
}

// 8 x 8 rendered pixels of one sample each are the 64-sample reference.
TEST_F(PointsPicture, IsNearerToManySamplesThanMultisampling) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    Settings settings = thesisAtRest();
    settings.camera.position = {0.2f, 0.06f, 0.36f};
    settings.camera.field_of_view = 45.0f;
    settings.render.width = 320;
    settings.render.height = 240;
    Settings many = settings;
    many.render.ssaa = 8;
    settings.render.msaa = 4;
    const fs::path reference =
        write("reference", settings, drawCase(device(), with(many, Backend::tessellation)));
    const fs::path multisampled =
        write("multisampled", settings, drawCase(device(), with(settings, Backend::tessellation)));
    const fs::path software =
        write("software", settings, drawCase(device(), with(settings, Backend::software)));
    const std::vector<double> errors =
        flipErrors({{reference, software}, {reference, multisampled}});
    EXPECT_LT(errors[0], errors[1]);
}

// The eye is in the hair, so that strands cross the near plane or are behind it.
TEST_F(PointsPicture, IsThatOfTessellationWithinTheHair) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    Settings settings = thesisAtRest();
    settings.camera.position = {0.0f, 0.02f, 0.11f};
    settings.camera.target = {0.08f, 0.0f, 0.02f};
    settings.camera.near_plane = 0.02f;
    settings.render.width = 480;
    settings.render.height = 300;
    const Pixels expected = drawCase(device(), with(settings, Backend::tessellation));
    EXPECT_GT(differingPixels(expected, drawBald(device(), settings)), 480u * 300u / 4u);
    for (const Way& way : kWays) {
        const std::vector<double> errors = flipErrors(
            {{write("t", settings, expected),
              write(way.name, settings, drawCase(device(), with(settings, way.backend)))}});
        EXPECT_LE(errors[0], way.most_different) << way.name;
    }
}

// A strand along the view from before the near plane to far beyond it: the back ends cut off the
// same part as the hardware.
TEST_F(PointsPicture, CutsStrandsAtTheNearPlane) {
    Settings settings;
    settings.strands.density = 1;
    settings.strands.root_width = settings.strands.tip_width = 0.05f;
    settings.camera.position = {0.0f, 0.0f, 0.5f};
    settings.camera.field_of_view = 45.0f;
    settings.camera.near_plane = 0.2f;
    settings.render.width = 640;
    settings.render.height = 480;
    settings.render.head = false;
    const groom::Groom groom = oneTriangle({{-0.1f, -0.05f, 0.6f}, {0.1f, 0.05f, -0.2f}});
    const Pixels expected =
        drawGroom(device(), with(settings, Backend::tessellation), groom, nullptr);
    Settings bald = settings;
    bald.render.hair = false;
    const Pixels empty = drawGroom(device(), bald, groom, nullptr);
    const std::size_t seen = differingPixels(expected, empty);
    EXPECT_GT(seen, 3000u);
    for (const Way& way : kWays) {
        const Pixels drawn = drawGroom(device(), with(settings, way.backend), groom, nullptr);
        // Pixels at its edges and its ends may fall to either side.
        std::size_t other = 0;
        for (std::size_t i = 0; i < expected.size(); i += 4) {
            const bool there = !std::equal(&expected[i], &expected[i] + 3, &empty[i]);
            const bool here = !std::equal(&drawn[i], &drawn[i] + 3, &empty[i]);
            other += there != here;
        }
        EXPECT_LT(other, seen / 50) << way.name;
    }
}

TEST_F(PointsPicture, ShowsNoStrandBehindTheCamera) {
    Settings settings;
    settings.strands.root_width = settings.strands.tip_width = 0.05f;
    settings.camera.position = {0.0f, 0.0f, 0.5f};
    settings.render.width = 160;
    settings.render.height = 120;
    const groom::Groom behind = oneTriangle({{-0.1f, 0.0f, 0.7f}, {0.1f, 0.1f, 2.0f}});
    const groom::Groom before = oneTriangle({{-0.1f, 0.0f, 0.2f}, {0.1f, 0.1f, 0.0f}});
    Settings bald = settings;
    bald.render.hair = false;
    const Pixels empty = drawGroom(device(), bald, behind, nullptr);
    for (const Way& way : kWays) {
        settings.strands.backend = way.backend;
        EXPECT_EQ(differingPixels(drawGroom(device(), settings, behind, nullptr), empty), 0u);
        EXPECT_GT(differingPixels(drawGroom(device(), settings, before, nullptr), empty), 50u);
    }
}

TEST_F(PointsPicture, ShowsNothingOfNoStrands) {
    Settings settings;
    settings.render.width = 64;
    settings.render.height = 48;
    groom::Groom groom = oneTriangle({{-0.1f, 0.0f, 0.2f}, {0.1f, 0.1f, 0.0f}});
    groom.root_triangles.clear();
    Settings bald = settings;
    bald.render.hair = false;
    const Pixels empty = drawGroom(device(), bald, groom, nullptr);
    for (const Way& way : kWays)
        EXPECT_EQ(
            differingPixels(
                drawGroom(device(), with(settings, way.backend), groom, nullptr), empty),
            0u)
            << way.name;
}

// A pixel is 1.2 m wide, and a strand in it 0.002 px. Phong's terms are not negative, so the
// ambient term is the least.
TEST_F(PointsPicture, HasOnePixel) {
    Settings settings = with(thesisAtRest(), Backend::software);
    settings.camera.position = {0.0f, 0.05f, 0.5f};
    settings.camera.target = {0.0f, 0.05f, 0.0f};
    settings.render.width = settings.render.height = 1;
    const Pixels drawn = drawCase(device(), settings);
    EXPECT_EQ(differingPixels(drawn, drawBald(device(), settings)), 1u);
    for (int i = 0; i < 3; ++i)
        EXPECT_GE(
            drawn.at(static_cast<std::size_t>(i)),
            std::floor(255.0f * settings.shading.ambient * settings.shading.color[i]));
}

// A picture that is wider than many targets. Its hair is 63 to 77 degrees off its middle and
// stretched
// to some 700 px.
TEST_F(PointsPicture, IsThatOfTessellationInAWidePicture) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    Settings settings = thesisAtRest();
    settings.render.width = 8192;
    settings.render.height = 256;
    settings.camera.position = {0.0f, 0.05f, 0.8f};
    settings.camera.target = {0.94f, 0.05f, 0.46f};
    const Pixels expected = drawCase(device(), settings);
    EXPECT_GT(differingPixels(expected, drawBald(device(), settings)), 8192u * 256u / 50u);
    const fs::path expected_path = write("wide", settings, expected);
    std::vector<std::pair<fs::path, fs::path>> pairs;
    for (const Way& way : kWays)
        pairs.emplace_back(
            expected_path,
            write(way.name, settings, drawCase(device(), with(settings, way.backend))));
    const std::vector<double> errors = flipErrors(pairs);
    ASSERT_EQ(errors.size(), kWays.size());
    for (std::size_t i = 0; i < errors.size(); ++i)
        EXPECT_LE(errors[i], kWays[i].most_different) << kWays[i].name;
}

// 176,000 pieces of about 17 x 35 samples are large, many more than their list has room for. None
// may be missing. Edges lie on other sides of samples, and more than 6 steps of a pixel's mean of
// 16 are at least a sample and a half: one pixel in 200 of the hair.
TEST_F(PointsPicture, HasMoreLargePiecesThanTheirListHolds) {
    Settings settings = thesisAtRest();
    settings.render.ssaa = 4;
    const Pixels expected = drawCase(device(), with(settings, Backend::tessellation));
    const std::size_t hair = differingPixels(expected, drawBald(device(), settings));
    EXPECT_GT(hair, 1280u * 720u / 30u);
    const Pixels drawn = drawCase(device(), with(settings, Backend::software));
    const std::vector<int> differences = channelDifferences(expected, drawn);
    EXPECT_LT(std::ranges::count_if(differences, [](int d) { return d > 6; }), 3 * hair / 200);
}

// The mean light of hair does not depend on the samples or on the back end. Supersampling shades
// each sample at its own place, as `software` does. Other back ends shade a pixel's samples of a
// strand once, at a place inside the strand: highlights are concave across a strand, and strands of
// a pixel's width get up to 3 % more. (At a place outside the quad, as before, the scene `msaa` had
// 0.983 of this light.)
TEST_F(PointsPicture, HasTheSameMeanLightWithAnySamples) {
    Settings settings = thesisAtRest();
    Settings many = settings;
    many.render.ssaa = 4;
    const Pixels truth = drawCase(device(), with(many, Backend::tessellation));
    const Pixels bald = drawBald(device(), many);
    const auto light = [&](const Pixels& pixels) {
        double sum = 0.0;
        for (std::size_t i = 0; i < truth.size(); i += 4)
            if (std::abs(int{truth[i]} - int{bald[i]}) > 4) sum += pixels.at(i);
        return sum;
    };
    EXPECT_GT(light(truth), 100.0 * 1280 * 720 / 30);  // hair of a thirtieth of the picture
    for (const Backend backend : {Backend::tessellation, Backend::expanded, Backend::software})
        for (const std::uint32_t samples : {1u, 2u, 4u, 8u}) {
            if (!device().supportsSamples(samples)) continue;
            settings.render.msaa = samples;
            const double ratio = light(drawCase(device(), with(settings, backend))) / light(truth);
            const bool once = samples > 1 && backend != Backend::software;
            EXPECT_NEAR(ratio, 1.0, once ? 0.03 : 0.01)
                << samples << " samples, " << static_cast<int>(backend);
        }
}

// A straight strand several pixels wide that nothing hides. Every pixel inside it is the same.
TEST_F(PointsPicture, ShadesAWideStrandAsTessellationDoes) {
    Settings settings;
    settings.strands.density = 1;
    settings.strands.root_width = settings.strands.tip_width = 0.04f;
    settings.camera.position = {0.0f, 0.0f, 0.5f};
    settings.render.width = 320;
    settings.render.height = 240;
    settings.render.head = false;
    const groom::Groom groom =
        oneTriangle({{-0.15f, -0.1f, 0.05f}, {0.0f, 0.0f, 0.0f}, {0.15f, 0.1f, -0.05f}});
    for (const ShadingModel model :
         {ShadingModel::phong, ShadingModel::kajiya_kay, ShadingModel::marschner,
          ShadingModel::dual_scattering}) {
        settings.shading.model = model;
        const Pixels expected =
            drawGroom(device(), with(settings, Backend::tessellation), groom, nullptr);
        for (const Way& way : kWays) {
            const Pixels drawn = drawGroom(device(), with(settings, way.backend), groom, nullptr);
            const std::vector<int> differences = channelDifferences(expected, drawn);
            // Two edges of some 70 px; rounding to 1/256 px moves few of them. Each pixel has
            // three channels.
            EXPECT_LT(std::ranges::count_if(differences, [](int d) { return d > 6; }), 60)
                << way.name << " " << static_cast<int>(model);
        }
    }
}

TEST_F(PointsPicture, IsTheSameEveryTime) {
    Settings settings = thesisAtRest();
    settings.render.width = 320;
    settings.render.height = 180;
    for (const Way& way : kWays) {
        settings.strands.backend = way.backend;
        const Pixels first = drawCase(device(), settings);
        for (int i = 0; i < 3; ++i)
            EXPECT_EQ(differingPixels(first, drawCase(device(), settings)), 0u) << way.name;
    }
}

// Tests drawing other than shaded and opaque with `expanded`, and levels of detail with fewer
// pieces than the finest.
TEST_F(PointsPicture, IsThatOfTessellationHoweverItIsShown) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    Settings plain = thesisAtRest();
    plain.render.width = 480;
    plain.render.height = 300;
    const std::vector<std::pair<const char*, void (*)(Settings&)>> kinds{
        {"lists", [](Settings& s) { s.render.transparency = Transparency::fragment_list; }},
        {"weighted", [](Settings& s) { s.render.transparency = Transparency::weighted_blended; }},
        {"covered", [](Settings& s) { s.render.coverage = Coverage::analytic; }},
        {"tangents", [](Settings& s) { s.render.show = Show::tangents; }},
        {"strands", [](Settings& s) { s.render.show = Show::strands; }},
        {"levels",
         [](Settings& s) {
             s.render.show = Show::lod;
             s.lod.mode = LodMode::distance;
             s.lod.near_distance = 0.42f;
             s.lod.far_distance = 0.6f;
         }},
        {"segments", [](Settings& s) { s.strands.taper = Taper::segment; }},
        {"segments' levels", [](Settings& s) {
             s.strands.taper = Taper::segment;
             s.lod.mode = LodMode::distance;
             s.lod.near_distance = 0.42f;
             s.lod.far_distance = 0.6f;
         }}};
    for (const auto& [name, change] : kinds) {
        Settings settings = plain;
        change(settings);
        const auto draw = [&](Backend backend, const char* file) {
            return write(file, settings, drawCase(device(), with(settings, backend)));
        };
        EXPECT_LE(
            flipErrors({{draw(Backend::tessellation, "t"), draw(Backend::expanded, "e")}})[0],
            0.005)
            << name;
    }
}

}  // namespace
}  // namespace hair::rendering
