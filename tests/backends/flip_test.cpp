#include "benchmarks/reference/picture_errors.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/pictures.h"
#include "tests/error_text.h"
#include "tests/flip_errors.h"
#include "tests/required.h"

namespace benchmarks::reference {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes plain(std::uint32_t pixels, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Bytes rgba;
    for (std::uint32_t i = 0; i < pixels; ++i) rgba.insert(rgba.end(), {r, g, b, 255});
    return rgba;
}

// Without edges the error is that of the colours. In CIELAB, black and white differ only in L, by
// 100. sRGB's green and blue are (87.735, -86.183, 83.179) and (32.297, 79.188, -107.860). With
// a and b times L / 100 their distance is 55.438 + |(-101.19, 107.81)| = 203.30. To the power 0.7
// the distances are 25.119 and 41.276; 0.4 of the greatest is 16.510, which maps to 0.95.
TEST(Flip, OfBlackAndWhiteIsThatOfThePaper) {
    const Bytes black = plain(32 * 24, 0, 0, 0);
    const Bytes white = plain(32 * 24, 255, 255, 255);
    const double expected = 0.95 + 0.05 * (25.119 - 16.510) / (41.276 - 16.510);
    EXPECT_NEAR(flipError(black, white, 32, 24), expected, 2e-4);
    EXPECT_NEAR(flipError(white, black, 32, 24), expected, 2e-4);
    EXPECT_EQ(flipError(white, white, 32, 24), 0.0);
}

TEST(Flip, IgnoresAlpha) {
    Bytes other = plain(12 * 12, 90, 120, 10);
    for (std::size_t i = 3; i < other.size(); i += 4) other[i] = 7;
    EXPECT_EQ(flipError(plain(12 * 12, 90, 120, 10), other, 12, 12), 0.0);
}

TEST(Flip, RefusesPicturesOfOtherSizes) {
    const Bytes picture = plain(12, 1, 2, 3);
    EXPECT_NE(errorText([&] { flipError(picture, plain(11, 1, 2, 3), 4, 3); }), "no error");
    EXPECT_NE(errorText([&] { flipError(picture, picture, 3, 3); }), "no error");
    EXPECT_NE(errorText([] { flipError({}, {}, 0, 0); }), "no error");
}

// Returns a picture of waves, edges and points. `which` changes colours and places.
Bytes pattern(int width, int height, int which) {
    Bytes rgba;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int edge = (x + which * y) / (5 + which) % 2 * 90;
            const int point = (x * 7 + y * (11 + which)) % 53 == 0 ? 80 : 0;
            for (const int channel : {0, 1, 2})
                rgba.push_back(static_cast<std::uint8_t>(
                    (x * (2 + channel) + y * which + edge + point + 30 * channel * which) % 256));
            rgba.push_back(255);
        }
    return rgba;
}

// Compares with the authors' program, which uses single precision.
TEST(Flip, IsThatOfItsAuthors) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const TemporaryFolder folder;
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> files;
    std::vector<double> ours;
    const auto add = [&](std::uint32_t width, std::uint32_t height, const Bytes& a,
                         const Bytes& b) {
        const std::string name = std::to_string(files.size());
        files.emplace_back(folder.path() / (name + "a.png"), folder.path() / (name + "b.png"));
        engine::writePng(files.back().first, width, height, a);
        engine::writePng(files.back().second, width, height, b);
        ours.push_back(flipError(a, b, width, height));
    };
    add(64, 48, pattern(64, 48, 1), pattern(64, 48, 2));
    add(31, 67, pattern(31, 67, 3), pattern(31, 67, 1));
    add(40, 40, plain(1600, 200, 30, 10), pattern(40, 40, 2));
    Bytes near = pattern(64, 48, 1);
    for (std::size_t i = 0; i < near.size(); i += 28) near[i] ^= 4;
    add(64, 48, pattern(64, 48, 1), near);
    for (const char* name : {"curly", "strong_wind"}) {
        const std::string pictures = HAIRBENCH_SOURCE_DIR "/results/pictures/";
        const engine::Pixels a = engine::readImage(pictures + "rest.png");
        const engine::Pixels b = engine::readImage(pictures + name + ".png");
        if (a.width == b.width && a.height == b.height) add(a.width, a.height, a.rgba, b.rgba);
    }
    EXPECT_GE(files.size(), 5u);
    const std::vector<double> theirs = flipErrors(files);
    ASSERT_EQ(theirs.size(), ours.size());
    for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], theirs[i], 1e-4) << i;
}

}  // namespace
}  // namespace benchmarks::reference
