#include "benchmarks/report/page.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/backends.h"
#include "benchmarks/report/baseline.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/report.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/program_files.h"

namespace benchmarks::report {
namespace {

// In the order in which the page has them: what a script uses while it is read stands before it.
constexpr const char* kScripts[] = {"page.js", "figures.js", "backends.js", "details.js"};

std::string readPart(const std::string& name) {
    return engine::readFile(engine::programFile("benchmarks/report/page/" + name));
}

std::string replaced(std::string_view text, char what, std::string_view with) {
    std::string result;
    for (const char each : text)
        if (each == what)
            result += with;
        else
            result += each;
    return result;
}

// Text as HTML shows it, in an element or a quoted attribute.
std::string escapedHtml(std::string_view text) {
    std::string result = replaced(text, '&', "&amp;");
    result = replaced(result, '<', "&lt;");
    result = replaced(result, '>', "&gt;");
    return replaced(result, '"', "&quot;");
}

// "A" to "Z", then "27" and so on.
std::string labelOf(std::size_t index) {
    return index < 26 ? std::string(1, static_cast<char>('A' + index)) : std::to_string(index + 1);
}

// The pictures are beside the report.
void addPictures(scene::Json& report, const std::filesystem::path& file, scene::Json& pictures) {
    for (scene::Json& each : report.at("cases")) {
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
void addMetrics(const scene::Json& report, scene::Json& pass_times, scene::Json& image_metrics) {
    for (const scene::Json& each : report.at("cases")) {
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
std::string titleOf(const scene::Json& reports) {
    std::vector<std::string> names;
    for (const scene::Json& report : reports) {
        const std::string name = sceneNameOf(report);
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    std::string title;
    for (const std::string& name : names) title += (title.empty() ? "" : ", ") + name;
    return title;
}

// The first report with each of the others.
scene::Json comparisonsOf(const scene::Json& reports) {
    scene::Json comparisons = scene::Json::array();
    for (std::size_t i = 1; i < reports.size(); ++i)
        comparisons.push_back(comparisonJson(
            compareReports(reports[0], reports[i], VerdictOptions{}), reports[0].at("file"),
            reports[i].at("file")));
    return comparisons;
}

}  // namespace

// ---- Parts --------------------------------------------------------------------------------------

std::optional<std::filesystem::path> findPlotly() {
    const char* wanted = std::getenv("HAIRBENCH_PLOTLY");
    const auto places = wanted && *wanted
                            ? std::vector<std::filesystem::path>{wanted}
                            : std::vector<std::filesystem::path>{
                                  engine::programFile("benchmarks/report/page/plotly-basic.min.js"),
                                  engine::programFile(".deps/plotly/plotly-basic.min.js")};
    std::error_code error;
    for (const std::filesystem::path& each : places)
        if (std::filesystem::is_regular_file(each, error)) return each;
    return std::nullopt;
}

std::string readPlotly() {
    const auto file = findPlotly();
    if (!file)
        throw engine::Error(
            "report",
            "plotly-basic.min.js is missing, which a page draws with: scripts/setup fetches it "
            "before the build, or HAIRBENCH_PLOTLY names one");
    return engine::readFile(*file);
}

PageParts readPageParts(std::string plotly) {
    std::string script;
    for (const char* name : kScripts) script += readPart(name) + '\n';
    return {
        .page = readPart("page.html"),
        .style = readPart("page.css"),
        .script = std::move(script),
        .plotly = std::move(plotly)};
}

// ---- Data ---------------------------------------------------------------------------------------

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? digits[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::optional<std::string> pictureUri(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    const std::string bytes = engine::readFile(file);
    if (bytes.starts_with("\x89PNG\r\n")) return "data:image/png;base64," + base64(bytes);
    if (bytes.starts_with("\xff\xd8\xff")) return "data:image/jpeg;base64," + base64(bytes);
    return std::nullopt;
}

scene::Json pageData(std::span<const std::filesystem::path> files) {
    scene::Json reports = scene::Json::array();
    scene::Json pictures = scene::Json::object();
    scene::Json pass_times = scene::Json::object();
    scene::Json image_metrics = scene::Json::object();
    for (const std::filesystem::path& file : files) try {
            scene::Json report = readReport(file);
            report["label"] = labelOf(reports.size());
            report["file"] = file.filename().string();
            addPictures(report, file, pictures);
            addMetrics(report, pass_times, image_metrics);
            if (const auto backends = compareBackends(report))
                report["backends"] = backendsJson(*backends);
            reports.push_back(std::move(report));
        } catch (const scene::Json::exception& error) {
            throw engine::Error(file.string(), error.what());
        }
    scene::Json comparisons = comparisonsOf(reports);
    const std::string title = titleOf(reports);
    return {
        {"title", title},
        {"reports", std::move(reports)},
        {"pass_times", std::move(pass_times)},
        {"image_metrics", std::move(image_metrics)},
        {"pictures", std::move(pictures)},
        {"comparisons", std::move(comparisons)}};
}

// ---- Page ---------------------------------------------------------------------------------------

std::string scriptJson(const scene::Json& data) {
    return replaced(
        data.dump(-1, ' ', false, scene::Json::error_handler_t::replace), '<', "\\u003c");
}

std::string assemblePage(const PageParts& parts, const scene::Json& data) {
    const std::string title =
        escapedHtml(data.at("title").get_ref<const std::string&>()) + " - hairbench";
    const std::string json = scriptJson(data);
    // In the order of the page, so that what is put in is never searched.
    const std::pair<std::string_view, std::string_view> places[] = {
        {"@title@", title},
        {"@style@", parts.style},
        {"@data@", json},
        {"@plotly@", parts.plotly},
        {"@script@", parts.script}};
    std::string_view rest = parts.page;
    std::string page;
    page.reserve(parts.page.size() + parts.plotly.size() + parts.script.size() + json.size());
    for (const auto& [place, text] : places) {
        const std::size_t found = rest.find(place);
        if (found == std::string_view::npos)
            throw engine::Error("page.html", std::string(place) + " is missing or out of order");
        page.append(rest.substr(0, found)).append(text);
        rest.remove_prefix(found + place.size());
    }
    return page.append(rest);
}

}  // namespace benchmarks::report
