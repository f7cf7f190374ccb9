#include "engine/pipeline_statistics.h"

namespace engine {

PipelineStatistics::PipelineStatistics(const Device& device) : device_(device.get()) {
    static_assert(
        VK_QUERY_PIPELINE_STATISTIC_TESSELLATION_EVALUATION_SHADER_INVOCATIONS_BIT ==
        1 << (kStatisticNames.size() - 1));
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
    create.queryCount = 1;
    create.pipelineStatistics = (1u << kStatisticNames.size()) - 1;
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
    StatisticCounts counts{};
    check(
        vkGetQueryPoolResults(
            device_, pool_.get(), 0, 1, sizeof counts, counts.data(), sizeof counts,
            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "read the pipeline statistics");
    return counts;
}

}  // namespace engine
