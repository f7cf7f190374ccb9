#include "benchmarks/gate/block_report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/report_file.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

BlockCase readCase(const Json& result) {
    BlockCase read{.outcome = caseOutcome(result), .metrics = {}};
    if (read.outcome.status != "ok") return read;
    read.metrics = readMetrics(result);
    return read;
}

}  // namespace

BlockReport readBlock(const std::filesystem::path& path) {
    const Json report = readReport(path);
    try {
        BlockReport block{
            .environment = Document(report.at("environment")),
            .scene = Document(Json{
                {"path", report.at("scene").at("path")}, {"hash", report.at("scene").at("hash")}}),
            .software_device = isSoftwareDevice(report.at("environment")),
            .cases = {}};
        for (const Json& each : report.at("cases")) block.cases.push_back(readCase(each));
        return block;
    } catch (const Json::exception& error) {
        throw engine::Error(path.string(), error.what());
    }
}

const BlockCase* findCase(const BlockReport& block, const std::string& name) {
    const auto found = std::ranges::find(
        block.cases, name, [](const BlockCase& each) { return each.outcome.name; });
    return found == block.cases.end() ? nullptr : &*found;
}

std::vector<CommonMetric> commonMetrics(const BlockReport& a, const BlockReport& b) {
    std::vector<CommonMetric> common;
    for (const BlockCase& each : a.cases) {
        const BlockCase* const other = findCase(b, each.outcome.name);
        if (!other) continue;
        for (const MetricReading& metric : each.metrics)
            if (const MetricReading* const same = findMetric(other->metrics, metric.id))
                common.push_back({each.outcome.name, &metric, same});
    }
    return common;
}

std::vector<Mismatch> mismatches(const BlockReport& a, const BlockReport& b) {
    std::vector<Mismatch> all;
    for (const BlockCase& each : a.cases) {
        const BlockCase* const other = findCase(b, each.outcome.name);
        if (!other) continue;
        const std::vector<Mismatch> found = mismatches(each.outcome, other->outcome);
        all.insert(all.end(), found.begin(), found.end());
    }
    return all;
}

}  // namespace benchmarks
