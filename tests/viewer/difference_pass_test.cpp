#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/viewer/picture_area.h"
#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/transfer.h"
#include "tests/gpu_fixture.h"

namespace benchmarks::viewer {
namespace {

using engine::Access;
using Bytes = std::vector<std::uint8_t>;  // [row][column] RGBA

struct Size {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t bytes() const { return std::size_t{4} * width * height; }
};

struct Outcome {
    DifferenceFigures figures;
    Bytes picture;
};

// Computes the same on the CPU, from its definition.
Outcome reference(const Bytes& a, const Bytes& b, std::uint32_t gain) {
    Outcome outcome;
    for (std::size_t pixel = 0; pixel < a.size(); pixel += 4) {
        bool differs = false;
        for (std::size_t i = pixel; i < pixel + 3; ++i) {
            const auto steps = static_cast<std::uint32_t>(std::abs(int{a[i]} - int{b[i]}));
            differs |= steps > 0;
            outcome.figures.most = std::max(outcome.figures.most, steps);
            outcome.figures.sum += steps;
            outcome.picture.push_back(static_cast<std::uint8_t>(std::min(steps * gain, 255u)));
        }
        outcome.picture.push_back(255);
        ++outcome.figures.pixels;
        if (differs) ++outcome.figures.different;
    }
    return outcome;
}

class DifferencePassTest : public GpuTest {
protected:
    static engine::Image image(Size size, VkImageUsageFlags usage) {
        return {
            device(),
            {.width = size.width,
             .height = size.height,
             .usage = usage,
             .name = "picture",
             .purpose = "tests"}};
    }

    static engine::Image picture(const Bytes& bytes, Size size) {
        engine::Image made =
            image(size, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
        const engine::Buffer staging(
            device(), {.size = bytes.size(),
                       .usage = engine::Usage::upload,
                       .name = "staging",
                       .purpose = "tests"});
        std::ranges::copy(std::as_bytes(std::span(bytes)), staging.mapped().begin());
        runOnce(device(), [&](engine::Commands& commands) {
            commands.transition(
                made, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
            commands.copy(staging, 0, made, 0);
            commands.transition(
                made, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        });
        return made;
    }

    static Outcome
    run(DifferencePass& pass, const Bytes& a, const Bytes& b, Size size, std::uint32_t gain) {
        const engine::Image a_image = picture(a, size), b_image = picture(b, size);
        const engine::Image output =
            image(size, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
        runOnce(device(), [&](engine::Commands& commands) {
            commands.transition(output, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
            pass.record(commands, a_image, b_image, output, gain);
            commands.transition(
                output, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        });
        const engine::Buffer pixels = engine::readImage(device(), output, 4);
        const auto* first = reinterpret_cast<const std::uint8_t*>(pixels.mapped().data());
        return {pass.figures(), {first, first + size.bytes()}};
    }
};

// Red has every pair of values once, and thus every difference. Green and blue have other
// differences. Alpha has some, which do not count.
TEST_F(DifferencePassTest, IsExactForEveryPairOfValues) {
    constexpr Size kSize{256, 256};
    Bytes a, b;
    for (unsigned y = 0; y < kSize.height; ++y) {
        for (unsigned x = 0; x < kSize.width; ++x) {
            for (const unsigned value : {x, x * 7, 31u, x}) a.push_back(value & 0xff);
            for (const unsigned value : {y, x * 7, 31u + (x == y), y}) b.push_back(value & 0xff);
        }
    }
    DifferencePass pass(device());
    for (const std::uint32_t gain : {1u, 2u, 4u, 8u, 16u}) {
        const Outcome expected = reference(a, b, gain);
        const Outcome outcome = run(pass, a, b, kSize, gain);
        EXPECT_EQ(outcome.figures, expected.figures) << gain;
        EXPECT_EQ(outcome.picture, expected.picture) << gain;
    }
}

// Sizes that do not fill whole work groups.
TEST_F(DifferencePassTest, CountsEveryPixelOfOddSizesOnce) {
    DifferencePass pass(device());
    for (const Size size : {Size{1, 1}, Size{13, 7}, Size{8, 9}, Size{1000, 3}}) {
        const Bytes a(size.bytes(), 10), b(size.bytes(), 13);
        const Outcome outcome = run(pass, a, b, size, 4);
        const std::uint64_t pixels = std::uint64_t{size.width} * size.height;
        EXPECT_EQ(
            outcome.figures,
            (DifferenceFigures{
                .pixels = pixels, .different = pixels, .most = 3, .sum = pixels * 9}));
        EXPECT_EQ(outcome.figures.mean(), 3.0);
        EXPECT_EQ(outcome.figures.share(), 1.0);
        EXPECT_EQ(outcome.picture, reference(a, b, 4).picture);
    }
}

TEST_F(DifferencePassTest, FindsNothingInEqualPicturesThatDifferInAlpha) {
    constexpr Size kSize{20, 20};
    Bytes a(kSize.bytes(), 77), b = a;
    for (std::size_t i = 3; i < b.size(); i += 4) b[i] = 200;
    DifferencePass pass(device());
    run(pass, a, Bytes(kSize.bytes(), 78), kSize, 4);  // the counts restart after this
    const Outcome outcome = run(pass, a, b, kSize, 16);
    EXPECT_EQ(outcome.figures, (DifferenceFigures{.pixels = 400}));
    EXPECT_EQ(outcome.picture, reference(a, b, 16).picture);
    EXPECT_EQ(differenceText(outcome.figures), "identical");
}

// A sum beyond 32 bits: 3 x 255 x 4096 x 1400 = 4,386,816,000 > 2^32.
TEST_F(DifferencePassTest, SumsMoreThan32Bits) {
    constexpr Size kSize{4096, 1400};
    DifferencePass pass(device());
    const Outcome outcome = run(pass, Bytes(kSize.bytes(), 0), Bytes(kSize.bytes(), 255), kSize, 1);
    EXPECT_EQ(outcome.figures.sum, 4'386'816'000u);
    EXPECT_EQ(outcome.figures.mean(), 255.0);
}

TEST(DifferenceText, SaysWhatWasCounted) {
    // 30 steps over 3 channels of 20 pixels.
    EXPECT_EQ(
        differenceText({.pixels = 20, .different = 5, .most = 12, .sum = 30}),
        "at most 12 of 255, on average 0.500; 25.0 % of the pixels differ");
    EXPECT_EQ(differenceText({.pixels = 20}), "identical");
}

}  // namespace
}  // namespace benchmarks::viewer
