#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/commands.h"

// Device queries: pipeline statistics, sample counts and timestamps.
namespace engine {

// The graphics counters of VkQueryPipelineStatisticFlagBits in bit order: bits 0 to 9, and bits 11
// and 12 for task and mesh stages. The compute counter is left out: lavapipe crashes on it if no
// compute pipeline is bound.
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

// Returns the counters that the device supports: those of task and mesh stages only with
// Feature::mesh_statistics.
std::span<const std::string_view> statisticNames(const Device& device);

using StatisticCounts = std::array<std::uint64_t, kStatisticNames.size()>;

// Kind of a query's draws. The query may count only stages that those draws have.
enum class DrawnFrom {
    vertices,
    meshes,  // task and mesh stages
};

class PipelineStatistics {
public:
    PipelineStatistics(const Device& device, DrawnFrom drawn_from);

    void begin(Commands& commands);
    void end(Commands& commands);
    // Returns the counts once the work is complete; 0 for stages that the draws don't have. Read
    // them once: on some drivers a second read differs.
    StatisticCounts read() const;

private:
    VkDevice device_;
    VkQueryPipelineStatisticFlags counted_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// Counts attachment samples that pass the depth test. The count is exact on every driver.
class SamplesQuery {
public:
    // Throws Unsupported if the device only knows whether any sample passed.
    explicit SamplesQuery(const Device& device);

    void begin(Commands& commands);
    void end(Commands& commands);
    // Returns the count once the work is complete.
    std::uint64_t read() const;

private:
    VkDevice device_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// A pool of GPU timestamps for one frame.
class Timestamps {
public:
    Timestamps(const Device& device, std::uint32_t capacity);

    // Makes the timestamps written since the last reset unavailable; the others already are. The
    // device must have finished the frame that wrote them.
    void reset();

    // Records a timestamp taken when all earlier commands are done, and returns its index. Throws
    // Error if the pool is full.
    std::uint32_t write(Commands& commands);

    // Returns each written timestamp in ms since the first. The work must be complete. A timestamp
    // that the device did not write is an Error. Valid until the next call.
    std::span<const double> read();

    std::uint32_t count() const { return count_; }

    // The first and the last timestamp of a read().
    struct Ends {
        std::uint64_t first;  // ticks
        std::uint64_t last;
        double period;  // ms per tick
        std::uint64_t mask;  // of the bits that count
    };
    // Needs a read() of at least one timestamp.
    Ends ends() const {
        return {results_.front().ticks, results_[count_ - 1].ticks, period_, mask_};
    }

private:
    struct Result {
        std::uint64_t ticks;
        std::uint64_t available;
    };

    VkDevice device_;
    double period_;  // ms per tick
    std::uint64_t mask_;
    std::uint32_t count_ = 0;
    std::vector<Result> results_;  // [capacity], like times_
    std::vector<double> times_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

// Returns how much faster the device's timestamps run than their stated period, by the host's clock
// over a tenth of a second (VK_EXT_calibrated_timestamps): 1 if they are right. Absent if device
// and host clocks can't be read at the same moment.
std::optional<double> timestampRate(const Device& device);

// Returns `now - before` of a counter that wraps at `mask` + 1 (a power of two).
constexpr std::uint64_t ticksBetween(std::uint64_t before, std::uint64_t now, std::uint64_t mask) {
    return (now - before) & mask;
}

// Returns ms from the last timestamp of `before` to the first of `after`. Negative if that is
// earlier: less than half of the counter's range apart, they are told apart.
constexpr double
millisecondsBetween(const Timestamps::Ends& before, const Timestamps::Ends& after) {
    const std::uint64_t ticks = ticksBetween(before.last, after.first, after.mask);
    if (ticks <= after.mask / 2) return static_cast<double>(ticks) * after.period;
    return -static_cast<double>(ticksBetween(after.first, before.last, after.mask)) * after.period;
}

// Returns the mask of the low `bits` bits, for timestampValidBits.
constexpr std::uint64_t validMask(std::uint32_t bits) {
    return bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
}

}  // namespace engine
