#include "engine/queries.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <thread>

#include "engine/error.h"

namespace engine {

// ---- Pipeline statistics ------------------------------------------------------------------------

namespace {

// Number of mesh counters in kStatisticNames.
constexpr std::size_t kMeshStatistics = 2;
constexpr std::size_t kVertexStatistics = kStatisticNames.size() - kMeshStatistics;
static_assert(
    VK_QUERY_PIPELINE_STATISTIC_TESSELLATION_EVALUATION_SHADER_INVOCATIONS_BIT ==
    1 << (kVertexStatistics - 1));

VkQueryPipelineStatisticFlags statisticBit(std::size_t index) {
    constexpr VkQueryPipelineStatisticFlags kTask =
        VK_QUERY_PIPELINE_STATISTIC_TASK_SHADER_INVOCATIONS_BIT_EXT;
    static_assert(VK_QUERY_PIPELINE_STATISTIC_MESH_SHADER_INVOCATIONS_BIT_EXT == kTask << 1);
    return index < kVertexStatistics ? 1u << index : kTask << (index - kVertexStatistics);
}

VkQueryPipelineStatisticFlags countedBits(const Device& device, DrawnFrom drawn_from) {
    if (drawn_from == DrawnFrom::vertices) return (1u << kVertexStatistics) - 1;
    VkQueryPipelineStatisticFlags counted =
        VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
        VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
        VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT;
    if (device.has(Feature::mesh_statistics))
        counted |= VK_QUERY_PIPELINE_STATISTIC_TASK_SHADER_INVOCATIONS_BIT_EXT |
                   VK_QUERY_PIPELINE_STATISTIC_MESH_SHADER_INVOCATIONS_BIT_EXT;
    return counted;
}

}  // namespace

std::span<const std::string_view> statisticNames(const Device& device) {
    const bool counts_meshes = device.has(Feature::mesh_statistics);
    return std::span(kStatisticNames)
        .first(counts_meshes ? kStatisticNames.size() : kVertexStatistics);
}

PipelineStatistics::PipelineStatistics(const Device& device, DrawnFrom drawn_from)
    : device_(device.get()), counted_(countedBits(device, drawn_from)) {
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
    create.queryCount = 1;
    create.pipelineStatistics = counted_;
    VkQueryPool pool{};
    check(vkCreateQueryPool(device_, &create, nullptr, &pool), "create a statistics pool");
    pool_ = {device_, pool};
}

void PipelineStatistics::begin(Commands& commands) {
    vkResetQueryPool(device_, pool_.get(), 0, 1);
    vkCmdBeginQuery(commands.get(), pool_.get(), 0, 0);
}

void PipelineStatistics::end(Commands& commands) { vkCmdEndQuery(commands.get(), pool_.get(), 0); }

StatisticCounts PipelineStatistics::read() const {
    StatisticCounts results{};  // consecutive, of the counted bits only
    check(
        vkGetQueryPoolResults(
            device_, pool_.get(), 0, 1, sizeof results, results.data(), sizeof results,
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "read the pipeline statistics");
    StatisticCounts counts{};
    std::size_t next = 0;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counted_ & statisticBit(i)) counts[i] = results[next++];
    return counts;
}

// ---- Samples that pass the depth test -----------------------------------------------------------

SamplesQuery::SamplesQuery(const Device& device) : device_(device.get()) {
    device.require(Feature::sample_counts, "samples query");
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_OCCLUSION;
    create.queryCount = 1;
    VkQueryPool pool{};
    check(vkCreateQueryPool(device_, &create, nullptr, &pool), "create an occlusion query pool");
    pool_ = {device_, pool};
}

void SamplesQuery::begin(Commands& commands) {
    vkResetQueryPool(device_, pool_.get(), 0, 1);
    vkCmdBeginQuery(commands.get(), pool_.get(), 0, VK_QUERY_CONTROL_PRECISE_BIT);
}

void SamplesQuery::end(Commands& commands) { vkCmdEndQuery(commands.get(), pool_.get(), 0); }

std::uint64_t SamplesQuery::read() const {
    std::uint64_t count = 0;
    check(
        vkGetQueryPoolResults(
            device_, pool_.get(), 0, 1, sizeof count, &count, sizeof count,
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "read an occlusion query");
    return count;
}

// ---- Timestamps ---------------------------------------------------------------------------------

namespace {

// Device ticks and ns of the host's monotonic clock, at the same moment.
struct Moment {
    std::uint64_t device;
    std::uint64_t host;
};

Moment readMoment(VkDevice device) {
    VkCalibratedTimestampInfoEXT wanted[2]{};
    for (VkCalibratedTimestampInfoEXT& each : wanted)
        each.sType = VK_STRUCTURE_TYPE_CALIBRATED_TIMESTAMP_INFO_EXT;
    wanted[0].timeDomain = VK_TIME_DOMAIN_DEVICE_EXT;
    wanted[1].timeDomain = VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT;
    // The process may be suspended between the two reads. The driver reports the deviation; keep
    // the least.
    Moment best{};
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (int i = 0; i < 8; ++i) {
        std::uint64_t times[2]{};
        std::uint64_t deviation = 0;
        check(
            vkGetCalibratedTimestampsEXT(device, 2, wanted, times, &deviation),
            "read the clocks of device and host");
        if (deviation < least) best = {times[0], times[1]};
        least = std::min(least, deviation);
    }
    return best;
}

bool knowsBothClocks(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    if (vkGetPhysicalDeviceCalibrateableTimeDomainsEXT(device, &count, nullptr) != VK_SUCCESS)
        return false;
    std::vector<VkTimeDomainEXT> domains(count);
    if (vkGetPhysicalDeviceCalibrateableTimeDomainsEXT(device, &count, domains.data()) !=
        VK_SUCCESS)
        return false;
    const auto has = [&](VkTimeDomainEXT domain) {
        return std::ranges::find(domains, domain) != domains.end();
    };
    return has(VK_TIME_DOMAIN_DEVICE_EXT) && has(VK_TIME_DOMAIN_CLOCK_MONOTONIC_EXT);
}

}  // namespace

std::optional<double> timestampRate(const Device& device) {
    const DeviceInfo& info = device.info();
    if (!device.has(Feature::calibrated_timestamps) || info.timestamp_valid_bits == 0 ||
        !knowsBothClocks(info.handle))
        return std::nullopt;
    const Moment before = readMoment(device.get());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const Moment after = readMoment(device.get());
    const std::uint64_t ticks =
        ticksBetween(before.device, after.device, validMask(info.timestamp_valid_bits));
    const double host = static_cast<double>(after.host - before.host);
    return static_cast<double>(ticks) * static_cast<double>(info.limits.timestampPeriod) / host;
}

Timestamps::Timestamps(const Device& device, std::uint32_t capacity)
    : device_(device.get()),
      period_(static_cast<double>(device.info().limits.timestampPeriod) * 1e-6),
      mask_(validMask(device.info().timestamp_valid_bits)), results_(capacity), times_(capacity) {
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_TIMESTAMP;
    create.queryCount = capacity;
    VkQueryPool pool{};
    check(vkCreateQueryPool(device_, &create, nullptr, &pool), "create a timestamp pool");
    pool_ = {device_, pool};
    vkResetQueryPool(device_, pool, 0, capacity);  // new queries have no defined state
}

void Timestamps::reset() {
    if (count_ > 0) vkResetQueryPool(device_, pool_.get(), 0, count_);
    count_ = 0;
}

std::uint32_t Timestamps::write(Commands& commands) {
    if (count_ == results_.size()) {
        throw Error(
            "a frame has more passes than " + std::to_string(results_.size()) + " timestamps");
    }
    vkCmdWriteTimestamp2(commands.get(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_.get(), count_);
    return count_++;
}

std::span<const double> Timestamps::read() {
    if (count_ == 0) return {};
    const std::span<Result> results = std::span(results_).first(count_);
    check(
        vkGetQueryPoolResults(
            device_, pool_.get(), 0, count_, results.size_bytes(), results.data(), sizeof(Result),
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT),
        "read the timestamps");
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (!results[i].available) throw Error("the device did not write a timestamp");
        const std::uint64_t ticks = ticksBetween(results.front().ticks, results[i].ticks, mask_);
        times_[i] = static_cast<double>(ticks) * period_;
    }
    return std::span(times_).first(count_);
}

}  // namespace engine
