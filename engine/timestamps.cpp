#include "engine/timestamps.h"

#include <string>

namespace engine {

Timestamps::Timestamps(const Device& device, std::uint32_t capacity)
    : device_(device.get()),
      period_(static_cast<double>(device.info().limits.timestampPeriod) * 1e-6),
      mask_(validMask(device.info().timestamp_valid_bits)), capacity_(capacity) {
    VkQueryPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    create.queryType = VK_QUERY_TYPE_TIMESTAMP;
    create.queryCount = capacity;
    VkQueryPool pool{};
    check(vkCreateQueryPool(device_, &create, nullptr, &pool), "create a timestamp pool");
    pool_ = {device_, pool};
    reset();
}

void Timestamps::reset() {
    vkResetQueryPool(device_, pool_.get(), 0, capacity_);
    count_ = 0;
}

std::uint32_t Timestamps::write(Commands& commands) {
    if (count_ == capacity_) {
        throw Error("a frame has more passes than " + std::to_string(capacity_) + " timestamps");
    }
    vkCmdWriteTimestamp2(commands.get(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pool_.get(), count_);
    return count_++;
}

std::vector<double> Timestamps::read() const {
    struct Stamp {
        std::uint64_t ticks;
        std::uint64_t available;
    };
    std::vector<Stamp> stamps(count_);
    if (count_ == 0) return {};
    check(
        vkGetQueryPoolResults(
            device_, pool_.get(), 0, count_, stamps.size() * sizeof(Stamp), stamps.data(),
            sizeof(Stamp), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT),
        "read the timestamps");
    std::vector<double> times;
    for (const Stamp& stamp : stamps) {
        if (!stamp.available) throw Error("the device did not write a timestamp");
        const std::uint64_t ticks = ticksBetween(stamps.front().ticks, stamp.ticks, mask_);
        times.push_back(static_cast<double>(ticks) * period_);
    }
    return times;
}

}  // namespace engine
