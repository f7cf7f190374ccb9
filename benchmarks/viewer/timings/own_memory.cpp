#include "benchmarks/viewer/timings/own_memory.h"

#include <algorithm>
#include <iterator>

#include "benchmarks/memory_metrics.h"

namespace benchmarks {

void OwnMemory::others(const std::function<void()>& action) {
    const auto before = all_.bytes();
    action();
    for (const auto& [entry, bytes] : all_.bytes()) others_[entry] += bytes;
    // What was there before is counted already. Sums are taken modulo 2^64, so that it may shrink.
    for (const auto& [entry, bytes] : before) others_[entry] -= bytes;
}

std::vector<Metric> OwnMemory::metrics() const {
    engine::MemoryLedger own;
    std::vector<engine::MemoryLedger::Line> lines;
    std::uint64_t sum = 0;
    for (const auto& [entry, bytes] : all_.bytes()) {
        const auto found = others_.find(entry);
        const std::uint64_t rest = bytes - (found == others_.end() ? 0 : found->second);
        if (rest > 0) lines.emplace_back(own, entry, rest);
        sum += rest;
    }
    std::vector<Metric> metrics{{ofMemory(Measured::allocated), {static_cast<double>(sum)}}};
    std::ranges::move(memoryMetrics(own), std::back_inserter(metrics));
    return metrics;
}

}  // namespace benchmarks
