#include "hair/rendering/strand_offsets.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/largest_difference.h"
#include "tests/rendering/device_hair.h"

// The table of offsets: thesis 2.3.8.2 and 2.3.8.3.
namespace hair::rendering {
namespace {

// Three parallel guides of this length, m.
groom::Groom straightGuides(double length) {
    std::vector<glm::vec3> guide;
    for (int v = 0; v < 16; ++v) guide.emplace_back(0.0, length * v / 15.0, 0.0);
    return oneTriangle(guide);
}

StrandOffsets
make(const StrandSettings& settings, double length, const groom::StrandSet* model = nullptr) {
    return makeStrandOffsets(settings, straightGuides(length), model, 7);
}

double fractionOf(const StrandOffsets& offsets, std::size_t sample) {
    return static_cast<double>(sample) / (offsets.samples - 1);
}

double radiusOf(const glm::vec3& offset) { return std::hypot(offset.x, offset.y); }

// The number of turns of the samples from `first` on, positive from the normal to the binormal.
double turnsOf(std::span<const glm::vec3> samples, std::size_t first) {
    double angle = 0.0;
    for (std::size_t i = first + 1; i < samples.size(); ++i) {
        const glm::dvec3 a(samples[i - 1]);
        const glm::dvec3 b(samples[i]);
        angle += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    }
    return angle / kTurn;
}

TEST(StrandOffsets, AreUsedWhereTheyDoSomething) {
    EXPECT_FALSE(hasOffsets({}));
    EXPECT_TRUE(hasOffsets({.curl = {.radius = 0.001f}}));
    EXPECT_TRUE(hasOffsets({.variation = {.amplitude = 0.001f}}));
    EXPECT_FALSE(hasOffsets({.variation = {.amplitude = 0.001f, .share = 0.0f}}));
    EXPECT_TRUE(hasOffsets({.offsets = "wisp.hair"}));
}

// 50 turns a metre on 0.3 m are 15, 4/5 of them past the start; a float rounds 0.004 by 2e-10.
TEST(StrandOffsets, CurlIsAHelixPastItsStart) {
    const StrandOffsets offsets = make(
        {.curl =
             {.radius = 0.004f, .frequency = 50.0f, .frequency_variation = 0.0f, .start = 0.2f}},
        0.3);
    EXPECT_EQ(offsets.profiles, 64u);
    EXPECT_GE(offsets.samples, 15u * 16u + 1u);
    for (std::uint32_t p = 0; p < offsets.profiles; ++p) {
        const auto samples = offsets.profile(p);
        EXPECT_EQ(samples[0], glm::vec3(0.0f));
        std::size_t first = 0;
        for (std::size_t i = 1; i < samples.size(); ++i) {
            EXPECT_EQ(samples[i].z, 0.0f);
            if (fractionOf(offsets, i) < 0.2) {
                EXPECT_LT(radiusOf(samples[i - 1]), radiusOf(samples[i]));  // it grows
                first = i + 1;
            } else {
                ASSERT_NEAR(radiusOf(samples[i]), 0.004, 1e-9);
            }
        }
        EXPECT_NEAR(
            turnsOf(samples, first), 15.0 * (1.0 - fractionOf(offsets, first)), 1e-6 * 15.0);
    }
}

TEST(StrandOffsets, CurlsDifferInPhaseAndFrequency) {
    const StrandOffsets offsets = make(
        {.curl =
             {.radius = 0.01f, .frequency = 100.0f, .frequency_variation = 0.25f, .start = 0.0f}},
        0.2);
    glm::dvec2 mean_phase(0.0);
    Extremes all_turns;
    for (std::uint32_t p = 0; p < offsets.profiles; ++p) {
        const auto samples = offsets.profile(p);
        const double turns = turnsOf(samples, 1) * (offsets.samples - 1) / (offsets.samples - 2);
        all_turns.add(turns);
        // Back from the first sample to the root.
        const double phase =
            std::atan2(samples[1].y, samples[1].x) - kTurn * turns / (offsets.samples - 1);
        mean_phase += glm::dvec2(std::cos(phase), std::sin(phase)) / 64.0;
    }
    // 20 turns within a quarter. The least and the greatest of 64 uniform numbers are within a
    // tenth of the ends, except with a probability of 2 * 0.9^64 = 0.2 %.
    EXPECT_GE(all_turns.least(), 15.0 - 1e-4);
    EXPECT_LE(all_turns.greatest(), 25.0 + 1e-4);
    EXPECT_LT(all_turns.least(), 16.0);
    EXPECT_GT(all_turns.greatest(), 24.0);
    EXPECT_LT(glm::length(mean_phase), 4.0 / std::sqrt(64.0));  // 4 deviations of a random walk
}

TEST(StrandOffsets, VariationIsBoundedSmoothAndOnAShareOfTheProfiles) {
    constexpr double kAmplitude = 0.01;
    const StrandOffsets offsets = make(
        {.variation = {.amplitude = 0.01f, .frequency = 40.0f, .share = 0.25f, .start = 0.0f}},
        0.25);
    // 10 changes on the strand. Between two of them the vector moves by at most the ball's
    // diameter, eased with a slope of 1.5.
    const double longest_step = 1.5 * 2.0 * kAmplitude * 10.0 / (offsets.samples - 1);
    std::uint32_t varied = 0;
    Extremes sizes;
    for (std::uint32_t p = 0; p < offsets.profiles; ++p) {
        const auto samples = offsets.profile(p);
        EXPECT_EQ(samples[0], glm::vec3(0.0f));
        Extremes of_profile;
        for (std::size_t i = 1; i < samples.size(); ++i) {
            of_profile.add(glm::length(glm::dvec3(samples[i])));
            if (i > 1) {
                ASSERT_LT(glm::distance(samples[i - 1], samples[i]), longest_step);
            }
        }
        varied += of_profile.greatest() > 0.0;
        sizes.add(of_profile.greatest());
    }
    EXPECT_EQ(varied, 16u);  // 64 / 4
    EXPECT_LE(sizes.greatest(), kAmplitude * (1.0 + 1e-6));
    EXPECT_GT(sizes.greatest(), 0.9 * kAmplitude);
}

TEST(StrandOffsets, CurlAndVariationAddUp) {
    StrandSettings settings{.curl = {.radius = 0.004f, .frequency = 80.0f}};
    const StrandOffsets curl = make(settings, 0.3);
    settings.variation = {.amplitude = 0.002f, .frequency = 20.0f, .share = 0.5f};
    const StrandOffsets both = make(settings, 0.3);
    ASSERT_EQ(both.samples, curl.samples);  // the curl's turns need more samples
    Extremes differences;
    for (std::uint32_t p = 0; p < 64; ++p) {
        const double difference = largestDifference(both.profile(p), curl.profile(p));
        EXPECT_LE(difference, p < 32 ? 0.002 * (1.0 + 1e-5) : 0.0) << p;
        differences.add(difference);
    }
    EXPECT_GT(differences.greatest(), 0.001);
}

// On parabolas, third differences are 0.
TEST(StrandOffsets, RunOnByAStepAtBothEnds) {
    const StrandOffsets offsets = make({.curl = {.radius = 0.01f, .start = 0.0f}}, 0.3);
    ASSERT_EQ(offsets.values.size(), std::size_t{64} * (offsets.samples + 2));
    const glm::vec3* const before = offsets.profile(63).data() - 1;
    const glm::vec3* const after = &*offsets.profile(63).end();
    EXPECT_EQ(after, &offsets.values.back());
    for (const glm::vec3* first : {before, after - 3}) {
        const glm::dvec3 third = glm::dvec3(first[3]) - glm::dvec3(first[0]) -
                                 3.0 * (glm::dvec3(first[2]) - glm::dvec3(first[1]));
        EXPECT_LT(glm::length(third), 4 * 0x1p-24 * 0.04);  // a float's roundings of 0.04 m
    }
}

TEST(StrandOffsets, RefuseMoreThanATableHolds) {
    EXPECT_EQ(
        errorText([] {
            make(
                {.curl = {.radius = 0.001f, .frequency = 1000.0f, .frequency_variation = 0.0f}},
                2.0);
        }),
        "/strands/curl/frequency: makes 2000 turns on a strand; offsets can have at most 1024");
    EXPECT_EQ(
        errorText([] { make({.variation = {.amplitude = 0.001f, .frequency = 10000.0f}}, 0.5); }),
        "/strands/variation/frequency: makes 5000 changes of direction on a strand; offsets can "
        "have at most 2048");
}

}  // namespace
}  // namespace hair::rendering
