#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/commands.h"

namespace engine {

// The graphics counters of VkQueryPipelineStatisticFlagBits, in the order of the bits 0 to 9. The
// compute counter is left out: lavapipe crashes on it when no compute pipeline is bound.
inline constexpr std::array<std::string_view, 10> kStatisticNames{
    "input_assembly_vertices",      "input_assembly_primitives",
    "vertex_invocations",           "geometry_invocations",
    "geometry_primitives",          "clipping_invocations",
    "clipping_primitives",          "fragment_invocations",
    "tessellation_control_patches", "tessellation_evaluation_invocations"};

using StatisticCounts = std::array<std::uint64_t, kStatisticNames.size()>;

// One pipeline-statistics query.
class PipelineStatistics {
public:
    explicit PipelineStatistics(const Device& device);

    void begin(Commands& commands);
    void end(Commands& commands);
    // The counts, once the work is complete. Read once: on some drivers a second read differs.
    StatisticCounts read() const;

private:
    VkDevice device_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

}  // namespace engine
