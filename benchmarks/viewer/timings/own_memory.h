#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "benchmarks/report.h"
#include "engine/memory_ledger.h"

namespace benchmarks {

// What one thing holds of the device's memory while others hold some too: what has joined since the
// beginning, but for what others did meanwhile.
class OwnMemory {
public:
    explicit OwnMemory(const engine::MemoryLedger& all) : all_(all), others_(all.bytes()) {}

    // Does what is not the thing's.
    void others(const std::function<void()>& action);

    // memory.device and memoryMetrics(), of it alone.
    std::vector<Metric> metrics() const;

private:
    const engine::MemoryLedger& all_;
    std::map<engine::MemoryLedger::Entry, std::uint64_t> others_;
};

}  // namespace benchmarks
