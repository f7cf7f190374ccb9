#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "tests/golden/features.h"
#include "tests/required.h"

// The host's work for a frame allocates nothing. Allocations are counted in a replaced operator
// new, so this is a separate program. They are counted per thread, because drivers have other
// threads.

namespace {

thread_local std::uint64_t allocations = 0;

void* counted(std::size_t bytes) {
    ++allocations;
    return std::malloc(bytes > 0 ? bytes : 1);
}

void* countedOrThrown(std::size_t bytes) {
    if (void* const memory = counted(bytes)) return memory;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) { return countedOrThrown(bytes); }
void* operator new[](std::size_t bytes) { return countedOrThrown(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return counted(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace benchmarks::measure {
namespace {

// Without validation, which keeps records of everything.
class HostAllocations : public testing::Test {
protected:
    void SetUp() override {
        try {
            device_.emplace(engine::DeviceOptions{});
        } catch (const engine::NoDevice& error) {
            skipWithout(Need::device, error.what());
        }
    }

    // Allocations in overlapped frames, after pipelines have been created and used. The frames are
    // small, because recording does not depend on sizes.
    std::uint64_t ofFrames(hair::Settings settings) {
        settings.render.width = 32;
        settings.render.height = 24;
        settings.strands.density = 1;
        settings.strands.tessellation = 1;
        settings.shading.shadows.resolution = std::min(settings.shading.shadows.resolution, 64u);
        settings.simulation.settle_steps = 0;
        for (hair::DistanceFieldSettings& field : settings.simulation.distance_fields)
            field.resolution = std::min(field.resolution, 8u);
        settings.simulation.solver = hair::Solver::shape;
        Case played(*device_, settings, HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(*device_, engine::Timing::overlapped);
        const auto play = [&](int frames) {
            for (int i = 0; i < frames; ++i)
                loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        };
        play(4);
        const std::uint64_t before = allocations;
        play(16);
        const std::uint64_t after = allocations;
        EXPECT_EQ(loop.finish().size(), 20u);
        return after - before;
    }

    std::optional<engine::Device> device_;
};

TEST_F(HostAllocations, AreCounted) {
    const std::uint64_t before = allocations;
    ::operator delete(::operator new(1));
    EXPECT_EQ(allocations - before, 1u);
}

TEST_F(HostAllocations, AreNoneInAFrameOfAnyBackEnd) {
    for (const hair::Backend backend :
         {hair::Backend::tessellation, hair::Backend::pulling_geometry, hair::Backend::lines,
          hair::Backend::pulling, hair::Backend::expanded, hair::Backend::mesh,
          hair::Backend::software, hair::Backend::rays}) {
        for (const std::uint32_t samples : {1u, 4u}) {
            hair::Settings settings = hair::plainSettings();
            settings.strands.backend = backend;
            settings.render.msaa = samples;
            try {
                EXPECT_EQ(ofFrames(settings), 0u)
                    << "back end " << static_cast<int>(backend) << ", samples " << samples;
            } catch (const engine::Unsupported&) {  // NOLINT(bugprone-empty-catch)
                // A device without these stages cannot draw such a frame.
            }
        }
    }
}

TEST_F(HostAllocations, AreNoneInAFrameOfAnyFeature) {
    for (const hair::Feature& feature : hair::features()) {
        hair::Settings settings = hair::plainSettings();
        feature.show(settings);
        EXPECT_EQ(ofFrames(settings), 0u) << feature.name;
    }
}

}  // namespace
}  // namespace benchmarks::measure
