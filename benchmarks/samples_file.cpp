#include "benchmarks/samples_file.h"

#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"
#include "benchmarks/statistics.h"
#include "engine/error.h"
#include "engine/read_file.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

namespace fs = std::filesystem;

// Beside what a link points to, as the report itself.
fs::path folderOf(const fs::path& report) { return fs::weakly_canonical(report).parent_path(); }

fs::path samplesFile(const fs::path& report) {
    return folderOf(report) / (fs::weakly_canonical(report).stem().string() + ".samples.jsonl");
}

using Key = std::pair<std::string, std::string>;  // case, metric

// Calls `visit` with the case's name, the metric's, and the metric, of each.
template <class Visit>
void forEachMetric(Json& report, Visit visit) {
    const auto cases = report.find("cases");
    if (cases == report.end()) return;
    for (Json& each : *cases) {
        const auto metrics = each.find("metrics");
        if (metrics == each.end()) continue;
        for (auto& [name, metric] : metrics->items())
            visit(each.at("name").template get<std::string>(), name, metric);
    }
}

// Puts `value` under `key` in the place of `old_key`.
void replaceMember(Json& object, const char* old_key, const char* key, Json value) {
    Json replaced = Json::object();
    for (auto& [name, member] : object.items()) {
        if (name == old_key)
            replaced[key] = std::move(value);
        else
            replaced[name] = std::move(member);
    }
    object = std::move(replaced);
}

std::map<Key, Json> readSamples(const fs::path& path) {
    std::map<Key, Json> samples;
    std::istringstream file(engine::readFile(path));
    for (std::string text; std::getline(file, text);) {
        Json line = parseJson(text, path.string());
        samples[{line.at("case"), line.at("metric")}] = std::move(line.at("samples"));
    }
    return samples;
}

// A report and samples of two runs can meet where one was killed between writing them.
bool fits(const Json& metric, const Json& samples) {
    return samples.size() == metric.at("sample_count").get<std::size_t>() && !samples.empty() &&
           summarize(samples.get<std::vector<double>>()).median ==
               metric.at("median").get<double>();
}

}  // namespace

bool moveSamplesOut(Json& report, const fs::path& path) {
    const fs::path file = samplesFile(path);
    std::string text;
    forEachMetric(report, [&](const std::string& name, const std::string& metric, Json& value) {
        const auto samples = value.find("samples");
        if (samples == value.end() || samples->size() <= kMostSamplesInReport) return;
        const std::size_t count = samples->size();
        text += Json{{"case", name}, {"metric", metric}, {"samples", std::move(*samples)}}.dump(
                    -1, ' ', false, Json::error_handler_t::replace) +
                '\n';
        replaceMember(value, "samples", "samples_file", file.filename().string());
        value["sample_count"] = count;
    });
    if (!text.empty()) engine::writeFileAtomically(file, text);
    return !text.empty();
}

void removeSamples(const fs::path& path) {
    std::error_code ignored;
    fs::remove(samplesFile(path), ignored);
}

void moveSamplesIn(Json& report, const fs::path& path) {
    std::map<std::string, std::map<Key, Json>> files;
    forEachMetric(report, [&](const std::string& name, const std::string& metric, Json& value) {
        const auto member = value.find("samples_file");
        if (member == value.end()) return;
        const auto file_name = member->get<std::string>();
        const fs::path file = folderOf(path) / file_name;
        if (!fs::is_regular_file(file))
            throw engine::Error(path.string(), "its samples are missing: " + file.string());
        if (!files.contains(file_name)) files[file_name] = readSamples(file);
        Json& samples = files[file_name][{name, metric}];
        if (!fits(value, samples))
            throw engine::Error(
                path.string(), file.string() + " is of another report: " + name + ", " + metric);
        value.erase("sample_count");
        replaceMember(value, "samples_file", "samples", std::move(samples));
    });
}

}  // namespace benchmarks
