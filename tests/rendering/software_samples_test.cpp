#include <span>

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

class SoftwareSamples : public GpuTest {
protected:
    static gpu::SamplePlaces placesOf(std::size_t samples) {
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(),
            {.shader = "probe_samples.comp",
             .constants = {{gpu::kPixelSamplesConstant, static_cast<std::uint32_t>(samples)}},
             .push_size = sizeof(gpu::SamplePlacesPush)});
        const gpu::SamplePlaces none{};
        const engine::Buffer buffer = engine::makeBuffer(
            device(), std::span<const gpu::SamplePlaces>(&none, 1), "sample places");
        runOnce(device(), [&](engine::Commands& commands) {
            commands.bind(pipeline, gpu::SamplePlacesPush{.places = buffer.address()});
            commands.dispatch(1);
            commands.barrier(engine::Access::compute_write, engine::Access::transfer_read);
        });
        return engine::downloadAs<gpu::SamplePlaces>(device(), buffer).front();
    }
};

TEST_F(SoftwareSamples, AreWhereVulkanHasThem) {
    for (const std::vector<glm::vec2>& standard : kStandard) {
        const gpu::SamplePlaces found = placesOf(standard.size());
        for (std::size_t i = 0; i < standard.size(); ++i)
            EXPECT_EQ(found.places[i], standard[i] / 16.0f) << i << " of " << standard.size();
    }
}

// With n rows, row k lies k + 1/2 of n parts down the pixel; columns are alike.
TEST_F(SoftwareSamples, AreOneInEachRowAndColumn) {
    for (const std::vector<glm::vec2>& standard : kStandard) {
        const gpu::SamplePlaces found = placesOf(standard.size());
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

}  // namespace
}  // namespace hair::rendering
