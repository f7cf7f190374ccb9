#pragma once

#include <cstdint>

#include "engine/commands.h"

namespace engine {

// How many samples of the attachments passed the depth test: a count that is exact on every driver.
class SamplesQuery {
public:
    // Throws Unsupported where the device only knows whether there were any.
    explicit SamplesQuery(const Device& device);

    void begin(Commands& commands);
    void end(Commands& commands);
    // Once the work is complete.
    std::uint64_t read() const;

private:
    VkDevice device_;
    Handle<VkQueryPool, &vkDestroyQueryPool> pool_;
};

}  // namespace engine
