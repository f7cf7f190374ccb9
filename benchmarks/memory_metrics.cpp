#include "benchmarks/memory_metrics.h"

#include <cstdint>
#include <map>
#include <string>

namespace benchmarks {

namespace {

struct Row {
    std::string_view beginning;  // of the names
    std::string_view purpose;
};

// The first row that fits counts. A new buffer needs a row only if no family of names fits.
constexpr Row kPurposes[] = {
    {"guide normals", "groom"},
    {"guide widths", "groom"},
    {"root ", "groom"},
    {"bound strands", "groom"},
    {"strand offsets", "groom"},
    {"guide ", "simulation"},
    {"settled state", "simulation"},
    {"shape ", "simulation"},
    {"ftl ", "simulation"},
    {"rod ", "simulation"},
    {"volume ", "simulation"},
    {"capsules", "simulation"},
    {"distance field", "simulation"},
    {"picture parameters", "shading"},
    {"lights' pictures", "shadows"},
    {"lights", "shading"},
    {"hair optics", "shading"},
    {"fiber averages", "shading"},
    {"environment", "shading"},
    {"shadow ", "shadows"},
    {"depth of ", "shadows"},
    {"opacity of hair", "shadows"},
    {"fragment ", "transparency"},
    {"weighted sum", "transparency"},
    {"revealed part", "transparency"},
    {"blend range", "transparency"},
    {"mesh texture coordinates", "meshes"},
    {"mesh texture", "textures"},
    {"no texture", "textures"},
    {"strand texture", "textures"},
    {"mesh ", "meshes"},
    {"body lines", "meshes"},
    {"color", "targets"},
    {"depth", "targets"},
    {"output", "targets"},
    {"radiance", "targets"},
    {"upload staging", "transfers"},
    {"download staging", "transfers"},
    {"picture", "transfers"},
    {"strand points", "measuring"},
    {"stage watch", "measuring"},
    {"busy work", "measuring"},
    {"window", "window"},
    {"shown picture", "window"},
    {"difference ", "window"},
};

Metric bytes(Measured what, std::string part, std::uint64_t count) {
    return {ofMemory(what, std::move(part)), {static_cast<double>(count)}};
}

}  // namespace

std::string_view memoryPurpose(std::string_view name) {
    for (const Row& row : kPurposes)
        if (name.starts_with(row.beginning)) return row.purpose;
    return "other";
}

std::vector<Metric> memoryMetrics(const engine::MemoryLedger& ledger) {
    std::map<std::uint32_t, std::uint64_t> heaps;
    std::map<std::string_view, std::uint64_t> purposes;
    for (const auto& [entry, size] : ledger.bytes()) {
        heaps[entry.heap] += size;
        purposes[memoryPurpose(entry.name)] += size;
    }
    std::vector<Metric> metrics;
    for (const auto& [heap, size] : heaps)
        metrics.push_back(bytes(Measured::heap, std::to_string(heap), size));
    for (const auto& [purpose, size] : purposes)
        metrics.push_back(bytes(Measured::purpose, std::string(purpose), size));
    return metrics;
}

}  // namespace benchmarks
