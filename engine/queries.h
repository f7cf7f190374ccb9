#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/commands.h"

// What the device counts and times: pipeline statistics, samples and timestamps.
namespace engine {

// The graphics counters of VkQueryPipelineStatisticFlagBits, in the order of their bits: 0 to 9,
// and 11 and 12 of task and mesh stages. The compute counter is left out: lavapipe crashes on it
// when no compute pipeline is bound.
inline constexpr std::array<std::string_view, 12> kStatisticNames{
    "input_assembly_vertices",
    "input_assembly_primitives",
    "vertex_invocations",
    "geometry_invocations",
    "geometry_primitives",
    "clipping_invocations",
    "clipping_primitives",
    "fragment_invocations",
    "tessellation_control_patches",
    "tessellation_evaluation_invocations",
    "task_invocations",
    "mesh_invocations"};

// Those that the device counts: not those of task and mesh stages without
// Feature::mesh_statistics.
std::span<const std::string_view> statisticNames(const Device& device);

using StatisticCounts = std::array<std::uint64_t, kStatisticNames.size()>;

// What a query's draws begin with. It may count only what they have.
enum class DrawnFrom {
    vertices,
    meshes,  // task and mesh stages
};

// One pipeline-statistics query.
class PipelineStatistics {
public:
    PipelineStatistics(const Device& device, DrawnFrom drawn_from);

    void begin(Commands& commands);
    void end(Commands& commands);
    // The counts, once the work is complete; 0 for stages that the draws don't have. Read once: on
    // some drivers a second read differs.
    StatisticCounts read() const;

private:
    VkDevice device_;
    VkQueryPipelineStatisticFlags counted_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// How many samples of the attachments passed the depth test: a count that is exact on every driver.
class SamplesQuery {
public:
    // Throws Unsupported where the device only knows whether there were any.
    explicit SamplesQuery(const Device& device);

    void begin(Commands& commands);
    void end(Commands& commands);
    // The count, once the work is complete.
    std::uint64_t read() const;

private:
    VkDevice device_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// A pool of GPU timestamps for one frame.
class Timestamps {
public:
    Timestamps(const Device& device, std::uint32_t capacity);

    // Makes the stamps written since the last reset unavailable again; others are so already. The
    // device must be done with the frame that wrote them.
    void reset();

    // Records a stamp that is taken when all earlier commands are done; returns its index. Throws
    // Error when all are taken.
    std::uint32_t write(Commands& commands);

    // ms since the first stamp, for each stamp written. The work must be complete; a stamp that the
    // device did not write is an Error. Valid until the next call.
    std::span<const double> read();

    std::uint32_t count() const { return count_; }

private:
    struct Stamp {
        std::uint64_t ticks;
        std::uint64_t available;
    };

    VkDevice device_;
    double period_;  // ms per tick
    std::uint64_t mask_;
    std::uint32_t count_ = 0;
    std::vector<Stamp> stamps_;  // as many as there may be, as times_
    std::vector<double> times_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// How much faster the device's timestamps run than their period says, by the host's clock over a
// tenth of a second (VK_EXT_calibrated_timestamps): 1 if they are right. Absent where the device
// and the host have no clock in common.
std::optional<double> timestampRate(const Device& device);

// `now - before` of a counter that wraps at `mask` + 1 (a power of two).
constexpr std::uint64_t ticksBetween(std::uint64_t before, std::uint64_t now, std::uint64_t mask) {
    return (now - before) & mask;
}

// Mask of the low `bits` bits, for timestampValidBits.
constexpr std::uint64_t validMask(std::uint32_t bits) {
    return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

}  // namespace engine
