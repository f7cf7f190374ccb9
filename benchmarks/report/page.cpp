#include "benchmarks/report/page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/compare.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/table.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/pattern.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::report {

// ---- Several devices ----------------------------------------------------------------------------

namespace {

using Pointers = std::set<std::string>;

// Adds the axes of all cases.
void addAxes(Pointers& pointers, const scene::Json& report) {
    for (const scene::Json& each : report.at("cases"))
        for (const auto& [pointer, value] : each.at("axes").items()) pointers.insert(pointer);
}

// Returns a key of the case's settings: its suite member, and its value on each axis. If its sweep
// lacks an axis, the scene's value counts.
std::string
playedBy(const scene::Json& report, const scene::Json& result, const Pointers& pointers) {
    const auto name = result.at("name").get<std::string>();
    scene::Json played = {name.substr(0, name.find('/'))};
    for (const std::string& pointer : pointers) {
        const auto own = result.at("axes").find(pointer);
        const scene::Json::json_pointer place("/scene/document" + pointer);
        if (own != result.at("axes").end())
            played.push_back(*own);
        else
            played.push_back(report.contains(place) ? report.at(place) : scene::Json());
    }
    return played.dump(-1, ' ', false, scene::Json::error_handler_t::replace);
}

// Returns the median frame time of each case in ms, by the keys from playedBy().
std::map<std::string, double> frameTimes(const scene::Json& report, const Pointers& pointers) {
    const scene::Json::json_pointer place("/metrics/" + ofFrame(Measured::time).name() + "/median");
    std::map<std::string, double> times;
    for (const scene::Json& each : report.at("cases")) {
        if (!each.contains(place) || !each.at(place).is_number()) continue;
        const auto time = each.at(place).get<double>();
        if (time > 0.0) times.emplace(playedBy(report, each, pointers), time);
    }
    return times;
}

std::optional<TimeRatio> timeRatio(const scene::Json& report, const scene::Json& first) {
    Pointers pointers;
    addAxes(pointers, first);
    addAxes(pointers, report);
    const std::map<std::string, double> reference = frameTimes(first, pointers);
    TimeRatio ratio;
    double sum = 0.0;
    for (const auto& [played, time] : frameTimes(report, pointers)) {
        const auto other = reference.find(played);
        if (other == reference.end()) continue;
        const double each = time / other->second;
        ratio.least = ratio.cases == 0 ? each : std::min(ratio.least, each);
        ratio.greatest = std::max(ratio.greatest, each);
        sum += std::log(each);
        ++ratio.cases;
    }
    if (ratio.cases == 0) return std::nullopt;
    ratio.mean = std::exp(sum / static_cast<double>(ratio.cases));
    return ratio;
}

}  // namespace

std::vector<OnDevice> compareDevices(std::span<const scene::Json> reports) {
    std::map<std::string, std::size_t> first_of;  // scene -> report
    std::vector<OnDevice> devices;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const std::size_t first = first_of.emplace(sceneNameOf(reports[i]), i).first->second;
        OnDevice& device = devices.emplace_back();
        device.report = i;
        device.first = first;
        if (first == i) continue;
        try {
            device.ratio = timeRatio(reports[i], reports[first]);
        } catch (const scene::Json::exception& error) {
            throw engine::Error("the reports can't be compared", scene::jsonReason(error));
        }
        device.differences = environmentDifferences(reports[first], reports[i]);
    }
    return devices;
}

scene::Json devicesJson(const std::vector<OnDevice>& devices) {
    scene::Json json = scene::Json::array();
    for (const OnDevice& each : devices) {
        json.push_back(
            {{"report", each.report}, {"first", each.first}, {"differences", each.differences}});
        if (each.ratio)
            json.back()["ratio"] = {
                {"cases", each.ratio->cases},
                {"mean", each.ratio->mean},
                {"least", each.ratio->least},
                {"greatest", each.ratio->greatest}};
    }
    return json;
}

// ---- The page -----------------------------------------------------------------------------------

namespace {

// In the order in which the page includes them. Code that a script runs on loading may only use
// earlier scripts.
constexpr const char* kScripts[] = {
    "page.js", "figures.js", "backends.js", "devices.js", "details.js"};

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

// Escapes text for HTML, in an element or a quoted attribute.
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

// Checks that a picture has a name as `run` gives, "a.pictures/12.png", and that no link leads
// elsewhere. A report may come from a stranger, and the page must show no other file of this
// machine.
bool isOwnPicture(const std::filesystem::path& folder, const std::filesystem::path& picture) {
    const scene::Pattern named("^[^/]+\\.pictures/[0-9]+\\.png$");
    if (!named.isIn(picture.string())) return false;
    std::error_code error;
    const std::filesystem::path real = std::filesystem::canonical(folder / picture, error);
    return !error && real == std::filesystem::canonical(folder, error) / picture;
}

// Adds the report's pictures, whose paths are relative to the report. A picture that is not the
// report's own is marked as missing.
void addPictures(scene::Json& report, const std::filesystem::path& file, scene::Json& pictures) {
    for (scene::Json& each : report.at("cases")) {
        const auto picture = each.find("picture");
        if (picture == each.end()) continue;
        const auto path = picture->get<std::string>();
        const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
        const auto uri = isOwnPicture(folder, path) ? pictureUri(folder / path) : std::nullopt;
        if (uri) {
            const std::string id = hashText(*uri);
            pictures[id] = *uri;
            each["picture_id"] = id;
        } else {
            each["picture_missing"] = path;
        }
    }
}

// Collects the metrics of pass times and of pictures.
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

// Judges the cases that ran.
void addVerdicts(scene::Json& report) {
    const scene::Json environment = report.value("environment", scene::Json::object());
    for (scene::Json& each : report.at("cases")) {
        const auto verdict = judgeCase(environment, each);
        if (!verdict) continue;
        scene::Json members = verdictJson(*verdict);
        each["verdict"] = {
            {"level", std::move(members["verdict"])},
            {"text", verdictText(*verdict)},
            {"reasons", std::move(members["reasons"])}};
    }
}

// Returns the names of the scenes, without duplicates.
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

// Compares each report with the first report of its scene if they have cases in common.
scene::Json comparisonsOf(const scene::Json& reports, const std::vector<OnDevice>& devices) {
    scene::Json comparisons = scene::Json::array();
    for (const OnDevice& each : devices) {
        if (each.first == each.report) continue;
        const scene::Json& first = reports[each.first];
        const scene::Json& other = reports[each.report];
        const ReportComparison found = compareReports(first, other, VerdictOptions{});
        if (found.common_cases == 0) continue;
        comparisons.push_back(comparisonJson(found, first.at("file"), other.at("file")));
        comparisons.back()["with"] = each.first;
        comparisons.back()["report"] = each.report;
    }
    return comparisons;
}

// Returns the kind of a file that is not a run's report, such as "hairbench-physics/1.0.0". Returns
// nothing if the kind is unknown.
std::optional<std::string> otherKind(const std::filesystem::path& file) {
    const scene::Json found = scene::parseJson(engine::readFile(file), file.string());
    if (!found.is_object()) return std::nullopt;
    const std::string schema = scene::textAt(found, "/schema");
    if (schema.starts_with("hairbench-") && !schema.starts_with("hairbench-report/")) return schema;
    if (scene::textAt(found, "/$schema").find("json-schema.org") != std::string::npos)
        return "a JSON Schema";
    return std::nullopt;
}

// Reads the reports of runs among the files, and lists the other files.
void readReports(
    std::span<const std::filesystem::path> files, std::vector<std::filesystem::path>& of_runs,
    scene::Json& reports, scene::Json& left_out) {
    for (const std::filesystem::path& file : files) try {
            reports.push_back(readReport(file));
            of_runs.push_back(file);
        } catch (const engine::Error&) {
            const std::optional<std::string> kind = otherKind(file);
            if (!kind) throw;
            left_out.push_back({{"file", file.filename().string()}, {"reason", *kind}});
        }
    if (reports.empty())
        throw engine::Error(
            files.front().string(), "is not a report of 'hairbench run' but " +
                                        left_out.front().at("reason").get<std::string>() +
                                        (files.size() > 1 ? ", nor is any other of these" : ""));
}

}  // namespace

// ---- Parts --------------------------------------------------------------------------------------

std::optional<std::filesystem::path> findPlotly() {
    const char* wanted = std::getenv("HAIRBENCH_PLOTLY");
    const auto places = wanted && *wanted
                            ? std::vector<std::filesystem::path>{wanted}
                            : std::vector<std::filesystem::path>{
                                  engine::programFile("benchmarks/report/page/plotly.min.js.gz"),
                                  engine::programFile(".deps/plotly/plotly.min.js.gz")};
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
            "plotly.min.js.gz, which draws the figures of a page, is missing: scripts/setup "
            "fetches it before the build, or HAIRBENCH_PLOTLY names a plotly.js");
    return engine::readFile(*file);
}

PageParts readPageParts(std::string_view plotly) {
    std::string script;
    for (const char* name : kScripts) script += readPart(name) + '\n';
    return {
        .page = readPart("page.html"),
        .style = readPart("page.css"),
        .script = std::move(script),
        .plotly = base64(plotly)};
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
    scene::Json left_out = scene::Json::array();
    std::vector<std::filesystem::path> of_runs;
    readReports(files, of_runs, reports, left_out);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        scene::Json& report = reports[i];
        const std::filesystem::path& file = of_runs[i];
        try {
            report["label"] = labelOf(i);
            report["file"] = file.filename().string();
            addPictures(report, file, pictures);
            addMetrics(report, pass_times, image_metrics);
            addVerdicts(report);
            if (const auto backends = compareBackends(report))
                report["backends"] = backendsJson(*backends);
        } catch (const scene::Json::exception& error) {
            throw engine::Error(file.string(), scene::jsonReason(error));
        }
    }
    const std::vector<OnDevice> devices =
        compareDevices(reports.get_ref<const scene::Json::array_t&>());
    scene::Json comparisons = comparisonsOf(reports, devices);
    const std::string title = titleOf(reports);
    return {
        {"title", title},
        {"reports", std::move(reports)},
        {"pass_times", std::move(pass_times)},
        {"image_metrics", std::move(image_metrics)},
        {"pictures", std::move(pictures)},
        {"comparisons", std::move(comparisons)},
        {"devices", devicesJson(devices)},
        {"left_out", std::move(left_out)}};
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
    // In the order of the page, so that inserted text is never searched.
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
