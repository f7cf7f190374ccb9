#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "engine/transfer.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"

// Tests that the back end `software` has its samples at the positions of multisampled images.
namespace hair::rendering {
namespace {

// Vulkan specification, Multisampling, standard sample locations; in sixteenths of a pixel.
const std::vector<std::vector<glm::vec2>> kStandard{
    {{8, 8}},
    {{12, 12}, {4, 4}},
    {{6, 2}, {14, 6}, {2, 10}, {10, 14}},
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};

constexpr std::uint32_t kSize = 16;  // of the picture, px

class SoftwareSamples : public GpuTest {
protected:
    // A sample that shows a piece.
    struct Shown {
        glm::vec2 place;  // px
        std::uint32_t piece;
        float depth;
    };

    // Runs the probe, which covers the quads in this order by so many invocations.
    struct Probe {
        gpu::SamplePlaces places;
        std::vector<Shown> shown;
    };
    static Probe
    probe(std::size_t samples, std::vector<gpu::QuadProbe> quads = {}, std::uint32_t group = 1) {
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(), {.shader = "probe_software.comp",
                       .constants =
                           {{gpu::kPixelSamplesConstant, static_cast<std::uint32_t>(samples)},
                            {gpu::kGroupConstant, group}},
                       .push_size = sizeof(gpu::SoftwarePush)});
        const auto count = static_cast<std::uint32_t>(quads.size());
        quads.resize(quads.size() + 1);  // a buffer has at least one
        const auto buffer = [&]<class Value>(const std::vector<Value>& values) {
            return engine::makeBuffer(device(), values, "software probe", "tests");
        };
        const engine::Buffer places = buffer(std::vector<gpu::SamplePlaces>(1));
        const engine::Buffer list = buffer(quads);
        const engine::Buffer pairs =
            buffer(std::vector(samples * kSize * kSize, glm::uvec2(gpu::kNoPiece, 0xffffffffu)));
        for (const std::uint32_t choice : {0u, 1u})
            runOnce(device(), [&](engine::Commands& commands) {
                commands.bind(
                    pipeline, gpu::SoftwarePush{
                                  .visibility = pairs.address(),
                                  .colors = places.address(),
                                  .list = list.address(),
                                  .width = kSize,
                                  .height = kSize,
                                  .strands = count,
                                  .choice = choice});
                commands.dispatch(1);
            });
        Probe result{engine::downloadAs<gpu::SamplePlaces>(device(), places).front(), {}};
        const auto found = engine::downloadAs<glm::uvec2>(device(), pairs);
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (found[i].x == gpu::kNoPiece) continue;
            const std::size_t pixel = i / samples;
            result.shown.push_back(
                {glm::vec2(pixel % kSize, pixel / kSize) + result.places.places[i % samples],
                 found[i].x, std::bit_cast<float>(~found[i].y)});
        }
        return result;
    }
};

// A quad from (x, y) down to (x, y + length), to both sides by `half`.
gpu::QuadProbe upright(float x, float y, float length, float half, std::uint32_t number = 0) {
    return {
        .from = {.place = {x, y}, .side = {half, 0}, .depth = 0.5f},
        .to = {.place = {x, y + length}, .side = {half, 0}, .depth = 0.5f},
        .number = number};
}

TEST_F(SoftwareSamples, AreWhereVulkanHasThem) {
    for (const std::vector<glm::vec2>& standard : kStandard) {
        const gpu::SamplePlaces found = probe(standard.size()).places;
        for (std::size_t i = 0; i < standard.size(); ++i)
            EXPECT_EQ(found.places[i], standard[i] / 16.0f) << i << " of " << standard.size();
    }
}

// With n rows, row k lies k + 1/2 of n parts down the pixel; columns are alike.
TEST_F(SoftwareSamples, AreOneInEachRowAndColumn) {
    for (const std::vector<glm::vec2>& standard : kStandard) {
        const gpu::SamplePlaces found = probe(standard.size()).places;
        for (std::size_t k = 0; k < standard.size(); ++k) {
            const float middle =
                16.0f * (static_cast<float>(k) + 0.5f) / static_cast<float>(standard.size());
            const glm::vec2 in_row = standard.at(found.row_samples[k]);
            const glm::vec2 in_column = standard.at(found.column_samples[k]);
            EXPECT_EQ(in_row, glm::vec2(16.0f * found.row_places[k], middle));
            EXPECT_EQ(in_column, glm::vec2(middle, 16.0f * found.column_places[k]));
        }
    }
}

// A sample on the common edge of two quads belongs to one of them, that beyond the edge. The
// samples are in the middle of pixels, as are all four edges.
TEST_F(SoftwareSamples, OnAnEdgeAreOfTheQuadThatItBoundsFromBelow) {
    for (const bool turned : {false, true}) {
        gpu::QuadProbe quad = upright(3.5f, 1.5f, 4.0f, 1.0f);
        if (turned)  // along a row
            for (gpu::QuadProbeEnd* end : {&quad.from, &quad.to})
                *end = {
                    .place = {end->place.y, end->place.x},
                    .side = {end->side.y, end->side.x},
                    .depth = end->depth};
        std::set<float> across, along;
        for (const Shown& shown : probe(1, {quad}).shown) {
            across.insert(turned ? shown.place.y : shown.place.x);
            along.insert(turned ? shown.place.x : shown.place.y);
        }
        EXPECT_EQ(across, (std::set{2.5f, 3.5f})) << turned;
        EXPECT_EQ(along, (std::set{1.5f, 2.5f, 3.5f, 4.5f})) << turned;
    }
}

// Invocations have whole rows of a quad, or parts of rows if there are fewer rows than invocations.
TEST_F(SoftwareSamples, AreAllTakenByAWorkGroup) {
    for (const std::uint32_t group : {1u, 8u, 32u, 64u}) {
        for (const std::uint32_t rows : {1u, 3u, 11u}) {
            const gpu::QuadProbe quad = upright(7.25f, 2.25f, static_cast<float>(rows), 6.5f);
            const std::vector<Shown> shown = probe(1, {quad}, group).shown;
            ASSERT_EQ(shown.size(), 13 * rows) << group;
            for (std::size_t i = 0; i < shown.size(); ++i) {
                const glm::vec2 expected(i % 13, i / 13);
                EXPECT_EQ(shown[i].place, expected + glm::vec2(1.5f, 2.5f)) << group;
            }
        }
    }
}

// The quad spreads and turns toward its second end, so the plane of its depth leaves the range of
// its ends in two of its corners: 1.02 and 0.02, worked out by hand.
TEST_F(SoftwareSamples, HaveNoDepthBeyondThoseOfTheEnds) {
    const gpu::QuadProbe quad{
        .from = {.place = {8, 3}, .side = {6, 0}, .depth = 0.2f},
        .to = {.place = {8, 9}, .side = {6, 5}, .depth = 0.8f},
        .number = 0};
    const std::vector<Shown> shown = probe(1, {quad}).shown;
    const auto depthAt = [&](const glm::vec2& place) {
        const auto found = std::ranges::find(shown, place, &Shown::place);
        return found == shown.end() ? -1.0f : found->depth;
    };
    EXPECT_EQ(depthAt({13.5f, 13.5f}), 0.8f);
    EXPECT_EQ(depthAt({13.5f, 3.5f}), 0.2f);
    EXPECT_NEAR(depthAt({7.5f, 6.5f}), 0.2 + 0.1 * (3.5 + 2.5 / 6.0 * 0.5), 1e-6);  // floats
}

TEST_F(SoftwareSamples, ShowTheFirstOfEquallyNearPieces) {
    const auto seen = [](const std::vector<gpu::QuadProbe>& quads) {
        std::set<std::uint32_t> pieces;
        for (const Shown& shown : probe(1, quads).shown) pieces.insert(shown.piece);
        return pieces;
    };
    const auto piece = [](std::uint32_t number) { return upright(4.0f, 1.0f, 4.0f, 1.0f, number); };
    EXPECT_EQ(seen({piece(3), piece(5), piece(7)}), std::set{3u});
    EXPECT_EQ(seen({piece(7), piece(5), piece(3)}), std::set{3u});
    gpu::QuadProbe nearest = piece(9);  // depth grows toward the eye
    nearest.from.depth = nearest.to.depth = 0.75f;
    EXPECT_EQ(seen({piece(3), nearest, piece(5)}), std::set{9u});
}

}  // namespace
}  // namespace hair::rendering
