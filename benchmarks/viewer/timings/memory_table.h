#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/memory_ledger.h"

namespace benchmarks {

// Device memory by what it is for, as bars, the largest first.
void memoryTable(const engine::MemoryLedger& ledger);

// "guides", "strands", "segments", ... and how many.
void countTable(
    const std::vector<std::pair<std::string, std::uint64_t>>& counts,
    const std::vector<std::pair<std::string, std::uint64_t>>* compared);

}  // namespace benchmarks
