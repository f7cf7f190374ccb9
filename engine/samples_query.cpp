#include "engine/samples_query.h"

#include "engine/error.h"

namespace engine {

SamplesQuery::SamplesQuery(const Device& device) : device_(device.get()) {
    VkPhysicalDeviceFeatures features{};
    vkGetPhysicalDeviceFeatures(device.info().handle, &features);
    if (!features.occlusionQueryPrecise)
        throw Unsupported("samples query", "the device does not count samples");
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

}  // namespace engine
