#pragma once

#include <string_view>
#include <vector>

#include "benchmarks/report.h"
#include "engine/memory_ledger.h"

namespace benchmarks {

// What a buffer or image of this name is for: "simulation", "groom", "targets", ...; "other" if its
// name is in no row of the table.
std::string_view memoryPurpose(std::string_view name);

// Device memory, B, each with one sample: "memory.heap.<index>" for each heap that holds something
// and "memory.purpose.<purpose>" for each purpose that does. Both add up to all that is allocated.
std::vector<Metric> memoryMetrics(const engine::MemoryLedger& ledger);

}  // namespace benchmarks
