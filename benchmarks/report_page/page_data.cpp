#include "benchmarks/report_page/page_data.h"

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/compare/report_comparison.h"
#include "benchmarks/hash.h"
#include "benchmarks/metric.h"
#include "benchmarks/report_file.h"
#include "benchmarks/report_page/picture_uri.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

// "A" to "Z", then "27" and so on.
std::string labelOf(std::size_t index) {
    return index < 26 ? std::string(1, static_cast<char>('A' + index)) : std::to_string(index + 1);
}

// The pictures are beside the report.
void addPictures(Json& report, const std::filesystem::path& file, Json& pictures) {
    for (Json& each : report.at("cases")) {
        const auto picture = each.find("picture");
        if (picture == each.end()) continue;
        const auto path = picture->get<std::string>();
        if (const auto uri = pictureUri(file.parent_path() / path)) {
            const std::string id = hashText(*uri);
            pictures[id] = *uri;
            each["picture_id"] = id;
        } else {
            each["picture_missing"] = path;
        }
    }
}

// Which metrics are of passes and of pictures.
void addMetrics(const Json& report, Json& pass_times, Json& image_metrics) {
    for (const Json& each : report.at("cases")) {
        const auto metrics = each.find("metrics");
        if (metrics == each.end()) continue;
        for (const auto& [name, metric] : metrics->items()) {
            const MetricId id = metricNamed(name);
            if (isPassTime(id)) pass_times[name] = id.pass();
            if (id.of == MetricOf::image) image_metrics[name] = true;
        }
    }
}

// The scene's name, or the scenes' if there are several.
std::string titleOf(const Json& reports) {
    std::vector<std::string> names;
    for (const Json& report : reports) {
        const std::string name =
            std::filesystem::path(report.at("scene").at("path").get<std::string>()).stem().string();
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    std::string title;
    for (const std::string& name : names) title += (title.empty() ? "" : ", ") + name;
    return title;
}

}  // namespace

Json pageData(std::span<const std::filesystem::path> files) {
    Json reports = Json::array();
    Json pictures = Json::object();
    Json pass_times = Json::object();
    Json image_metrics = Json::object();
    for (const std::filesystem::path& file : files) try {
            Json report = readReport(file);
            report["label"] = labelOf(reports.size());
            report["file"] = file.filename().string();
            addPictures(report, file, pictures);
            addMetrics(report, pass_times, image_metrics);
            reports.push_back(std::move(report));
        } catch (const Json::exception& error) {
            throw engine::Error(file.string(), error.what());
        }
    Json comparisons = Json::array();
    for (std::size_t i = 1; i < reports.size(); ++i)
        comparisons.push_back(comparisonJson(
            compareReports(reports[0], reports[i], VerdictOptions{}), reports[0].at("file"),
            reports[i].at("file")));
    const std::string title = titleOf(reports);
    return {
        {"title", title},
        {"reports", std::move(reports)},
        {"pass_times", std::move(pass_times)},
        {"image_metrics", std::move(image_metrics)},
        {"pictures", std::move(pictures)},
        {"comparisons", std::move(comparisons)}};
}

}  // namespace benchmarks
