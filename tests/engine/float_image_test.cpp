#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "hair/random.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path kStudio = HAIRBENCH_SCENES_DIR "/assets/studio.exr";

TEST(FloatImage, ExrKeepsEveryBitThatWasWritten) {
    const TemporaryFolder folder;
    std::vector<float> rgb;
    for (int i = 0; i < 3 * 7 * 5; ++i) rgb.push_back(std::ldexp(1.0f + 0.01f * i, i % 40 - 20));
    rgb[4] = -3.5f;
    rgb[5] = 1e30f;
    const auto path = folder.path() / "made" / "a.exr";
    writeExr(path, 7, 5, rgb);
    const FloatPixels pixels = readFloatImage(path);
    EXPECT_EQ(pixels.width, 7u);
    EXPECT_EQ(pixels.height, 5u);
    EXPECT_EQ(pixels.rgb, rgb);
    const std::filesystem::directory_iterator beside(path.parent_path());
    EXPECT_EQ(std::distance(begin(beside), end(beside)), 1);
}

// scenes/assets/make_sky.py writes half-precision zipped lines by the published layout, and Mitsuba
// can read them. Its values: BELOW under the horizon, ABOVE over it (without a box), and the key
// light's radiance. Half precision rounds by 2^-11.
TEST(FloatImage, ReadsAnExrOfAnotherWriter) {
    const FloatPixels pixels = readFloatImage(kStudio);
    ASSERT_EQ(pixels.width, 256u);
    ASSERT_EQ(pixels.height, 128u);
    const auto expect = [&](std::size_t row, std::size_t column, std::array<float, 3> light) {
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(pixels.rgb[3 * (256 * row + column) + i], light[i], light[i] / 2048.0f)
                << row << ' ' << column;
        }
    };
    expect(127, 10, {0.06f, 0.05f, 0.045f});
    expect(0, 10, {0.30f, 0.32f, 0.36f});
    // Towards (0.75, 0.45, 0.75): 45 degrees from +z towards +x, 67 degrees from +y.
    expect(47, 96, {8.0f, 7.4f, 6.6f});
}

// Greg Ward, Real Pixels, Graphics Gems II (1991), and the reference manual of Radiance: flat
// pixels are RGB mantissas with a common factor 2^(e - 136).
TEST(FloatImage, ReadsRadiancePixels) {
    const TemporaryFolder folder;
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    for (const int byte : {128, 64, 32, 129, 200, 100, 50, 138}) bytes += static_cast<char>(byte);
    const FloatPixels pixels = readFloatImage(folder.write("a.hdr", bytes));
    EXPECT_EQ(pixels.width, 2u);
    EXPECT_EQ(pixels.height, 1u);
    EXPECT_EQ(pixels.rgb, (std::vector<float>{1.0f, 0.5f, 0.25f, 800.0f, 400.0f, 200.0f}));
}

// The same manual: in rows of at least 8 pixels, each channel may be in runs: 128 + n and one byte,
// or n and n bytes.
TEST(FloatImage, ReadsRadianceRuns) {
    const TemporaryFolder folder;
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
    for (int row = 0; row < 2; ++row) {
        for (const int byte :
             {2, 2, 0, 8, 128 + 8, 128, 2, 64, 32, 128 + 6, 16, 128 + 8, 0, 128 + 5, 129, 128 + 3,
              130})
            bytes += static_cast<char>(byte);
    }
    const FloatPixels pixels = readFloatImage(folder.write("a.hdr", bytes));
    ASSERT_EQ(pixels.rgb.size(), 3u * 8 * 2);
    for (std::size_t row = 0; row < 2; ++row) {
        for (std::size_t x = 0; x < 8; ++x) {
            const float unit = x < 5 ? 1.0f / 128 : 2.0f / 128;
            const std::size_t at = 3 * (8 * row + x);
            EXPECT_EQ(pixels.rgb[at], 128 * unit) << x;
            EXPECT_EQ(pixels.rgb[at + 1], (x == 0 ? 64 : x == 1 ? 32 : 16) * unit) << x;
            EXPECT_EQ(pixels.rgb[at + 2], 0.0f) << x;
        }
    }
    // Truncates the file everywhere, and changes every byte of the pixels.
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto path = folder.write("cut.hdr", bytes.substr(0, size));
        EXPECT_THAT(errorText([&] { readFloatImage(path); }), StartsWith(path.string() + ": "))
            << size;
    }
    for (std::size_t at = bytes.size() - 34; at < bytes.size(); ++at) {
        for (int value = 0; value < 256; ++value) {
            std::string damaged = bytes;
            damaged[at] = static_cast<char>(value);
            errorText([&] { readFloatImage(folder.write("damaged.hdr", damaged)); });
        }
    }
}

// A kilobyte that claims 800 MB of floats.
TEST(FloatImage, RefusesAnExrThatIsTooShortForItsSize) {
    const TemporaryFolder folder;
    const std::vector<float> rgb(3 * 8 * 8, 1.0f);
    writeExr(folder.file("a.exr"), 8, 8, rgb);
    std::string bytes = textOf(folder.file("a.exr"));
    // OpenEXR itself requires a table of the window's rows.
    for (const auto& [window, reason] :
         {std::pair{std::string("dataWindow"), "ends too early"},
          {std::string("displayWindow"), "ends too early for a picture of its size"}}) {
        std::string huge = bytes;
        // The name, "box2i" and a size, each with its terminator, then two corners.
        const std::size_t corner = huge.find(window) + window.size() + 1 + 6 + 4 + 8;
        ASSERT_EQ(huge.substr(corner, 8), std::string("\7\0\0\0\7\0\0\0", 8));
        huge.replace(corner, 8, std::string("\xff\x1f\0\0\xff\x1f\0\0", 8));  // 8192 by 8192
        EXPECT_THAT(
            errorText([&] { readFloatImage(folder.write("huge.exr", huge)); }), HasSubstr(reason))
            << window;
    }
}

// A header attribute that claims 2 GB.
TEST(FloatImage, RefusesAnExrThatIsTooShortForItsHeader) {
    const TemporaryFolder folder;
    writeExr(folder.file("a.exr"), 2, 2, std::vector<float>(12, 1.0f));
    std::string bytes = textOf(folder.file("a.exr"));
    const std::string before("compression\0compression\0", 24);  // name and type
    const std::size_t size = bytes.find(before) + before.size();
    ASSERT_EQ(bytes.substr(size, 4), std::string("\1\0\0\0", 4));
    bytes.replace(size, 4, "\xff\xff\xff\x7f");
    EXPECT_THAT(
        errorText([&] { readFloatImage(folder.write("huge.exr", bytes)); }),
        HasSubstr("ends too early for its header"));
}

TEST(FloatImage, NamesTheFileThatItCannotRead) {
    const TemporaryFolder folder;
    EXPECT_EQ(errorText([] { readFloatImage("no.exr"); }), "no.exr: no such file");
    for (const std::string_view content :
         {"", "hello, this is text", "\x76\x2f\x31\x01", "#?RADIANCE\n", "\x89PNG\r\n\x1a\n"}) {
        const auto path = folder.write("bad.exr", content);
        const std::string text = errorText([&] { readFloatImage(path); });
        EXPECT_THAT(text, StartsWith(path.string() + ": "));
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
    const std::string large = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n";
    EXPECT_THAT(
        errorText([&] { readFloatImage(folder.write("large.hdr", large + "abcd")); }),
        HasSubstr("large"));
}

TEST(FloatImage, RefusesAnExrThatEnds) {
    const TemporaryFolder folder;
    const std::string bytes = textOf(kStudio);
    for (std::size_t size = 4; size < bytes.size(); size += 97) {
        const auto path = folder.write("cut.exr", bytes.substr(0, size));
        EXPECT_THAT(errorText([&] { readFloatImage(path); }), StartsWith(path.string() + ": "))
            << size;
    }
}

// A damaged file gives an error or a picture, but never a crash. The first 400 bytes are the header
// and the table of blocks.
TEST(FloatImage, SurvivesDamage) {
    const TemporaryFolder folder;
    const std::string bytes = textOf(kStudio);
    std::size_t refused = 0;
    for (std::uint32_t i = 0; i < 300; ++i) {
        std::string damaged = bytes;
        const std::size_t range = i % 2 == 0 ? 400 : bytes.size();
        for (std::uint32_t k = 0; k < 1 + i % 3; ++k) {
            const std::uint32_t random = hair::hash(i, k, 0);
            damaged[4 + random % (range - 4)] = static_cast<char>(random >> 24);
        }
        const auto path = folder.write("damaged.exr", damaged);
        const std::string text = errorText([&] {
            const FloatPixels pixels = readFloatImage(path);
            ASSERT_EQ(pixels.rgb.size(), std::size_t{3} * pixels.width * pixels.height);
        });
        if (text == "no error") continue;
        EXPECT_THAT(text, StartsWith(path.string() + ": "));
        ++refused;
    }
    EXPECT_GT(refused, 30u);  // names and types of required attributes are half of the header
}

TEST(FloatImage, SaysWhichFileItCannotWrite) {
    const TemporaryFolder folder;
    const std::vector<float> rgb(3);
    EXPECT_THAT(
        errorText([&] { writeExr(folder.path(), 1, 1, rgb); }),
        StartsWith(folder.path().string() + ": "));
}

}  // namespace
}  // namespace engine
