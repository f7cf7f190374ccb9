#include "benchmarks/viewer/timings/viewer_report.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/environment.h"
#include "benchmarks/hash.h"
#include "benchmarks/report_file.h"
#include "benchmarks/run/case_picture.h"
#include "benchmarks/write_settings.h"

namespace benchmarks {

Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    CaseResult result) {
    Document document(writeSettings(settings));
    Report report;
    report.environment =
        describeEnvironment(device, origin.command, settings.seed, origin.validation);
    report.scene.path = origin.scene.string();
    report.scene.hash = hashText(document.text());
    report.scene.document = std::move(document);
    report.case_count = 1;
    result.name = origin.name;
    result.index = result.order = 0;
    report.cases.push_back(std::move(result));
    return report;
}

std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind) {
    return std::filesystem::path("results/local") / (origin.name + '-' + kind + ".json");
}

void saveReport(
    Report report, const hair::RenderSettings& render, std::span<const std::uint8_t> picture,
    const std::filesystem::path& file) {
    if (!picture.empty())
        report.cases.front().picture =
            writeCasePicture(picture, render.width, render.height, file, 0);
    writeReport(reportJson(report), file);
}

}  // namespace benchmarks
