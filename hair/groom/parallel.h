#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

#include "engine/process.h"

namespace hair::groom {

// Calls `work` for each index below `count`, in any order and on all processors, as a step of this
// name. Passes exceptions on.
template <class Work>
void inParallel(const char* name, std::uint32_t count, Work&& work) {
    static constexpr std::uint32_t kTaken = 256;  // indices at a time
    engine::Step step(name, count);
    std::atomic<std::uint64_t> next = 0;
    const auto take = [&] {
        for (std::uint64_t first = next.fetch_add(kTaken); first < count;
             first = next.fetch_add(kTaken)) {
            const std::uint64_t end = std::min<std::uint64_t>(first + kTaken, count);
            for (std::uint64_t i = first; i < end; ++i) work(static_cast<std::uint32_t>(i));
            step.advance(end - first);
        }
    };
    const std::uint32_t takers =
        std::min((count + kTaken - 1) / kTaken, std::thread::hardware_concurrency());
    std::vector<std::future<void>> others;
    for (std::uint32_t i = 1; i < takers; ++i)
        others.push_back(std::async(std::launch::async, take));
    take();
    for (std::future<void>& other : others) other.get();
}

}  // namespace hair::groom
