#include "benchmarks/run/merge_reports.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/run/record.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"

namespace benchmarks::run {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNamed = 8;

struct Part {
    fs::path path;
    scene::Json report;
};

// Throws an objection, or notes it with `force`.
class Judge {
public:
    Judge(bool force, std::vector<std::string>& notes) : force_(force), notes_(notes) {}

    void object(const fs::path& path, const std::string& reason) {
        if (!force_) throw engine::Error(path.string(), reason);
        notes_.push_back(path.string() + ": " + reason);
    }

private:
    bool force_;
    std::vector<std::string>& notes_;
};

// Cases of older reports have no index and come last.
std::size_t indexOf(const scene::Json& result) {
    return result.value("index", std::numeric_limits<std::size_t>::max());
}

// Rewrites the picture's path relative to the new report's folder.
void moveReference(scene::Json& result, const fs::path& from, const fs::path& to) {
    if (!result.contains("picture")) return;
    const fs::path file = fs::absolute(from).parent_path() / result["picture"].get<std::string>();
    const fs::path folder = fs::absolute(to).parent_path();
    const fs::path relative = file.lexically_normal().lexically_relative(folder.lexically_normal());
    result["picture"] = (relative.empty() ? file : relative).generic_string();
}

// Moves the cases out of the parts.
std::vector<scene::Json> joinedCases(std::vector<Part>& parts, const fs::path& out, Judge& judge) {
    std::vector<scene::Json> cases;
    std::map<std::string, fs::path> names;
    std::map<std::size_t, fs::path> indices;
    for (Part& part : parts)
        for (scene::Json& result : part.report.at("cases")) {
            const auto name = result.at("name").get<std::string>();
            const std::size_t index = indexOf(result);
            if (const auto earlier = names.find(name); earlier != names.end()) {
                judge.object(part.path, name + " is also in " + earlier->second.string());
                continue;
            }
            if (const auto earlier = indices.find(index);
                result.contains("index") && earlier != indices.end()) {
                judge.object(
                    part.path, name + " has the number " + std::to_string(index) +
                                   " of another case of " + earlier->second.string());
                continue;
            }
            names[name] = part.path;
            indices[index] = part.path;
            moveReference(result, part.path, out);
            cases.push_back(std::move(result));
        }
    std::ranges::stable_sort(cases, {}, indexOf);
    return cases;
}

// Whether the reports are all the shards of a sweep and each is complete. Missing cases were then
// left out by --filter.
bool areAllShards(const std::vector<Part>& parts) {
    std::set<std::size_t> indices;
    std::set<std::size_t> counts;
    for (const Part& part : parts) {
        const scene::Json shard = part.report.value("shard", scene::Json::object());
        if (shard.empty() || part.report.value("interrupted", false)) return false;
        indices.insert(shard.at("index").get<std::size_t>());
        counts.insert(shard.at("count").get<std::size_t>());
    }
    return counts.size() == 1 && indices.size() == *counts.begin();
}

// "5 of 12 cases are missing: number 1, 4, 7 ... of the sweep, counted from 0"; empty if none is
// missing. `count` comes from a report, so nothing of that size is allocated.
std::string missingText(const std::vector<scene::Json>& cases, std::size_t count) {
    std::set<std::size_t> found;
    for (const scene::Json& result : cases)
        if (indexOf(result) < count) found.insert(indexOf(result));
    const std::size_t missing = count - found.size();
    if (missing == 0) return {};
    std::string text = std::to_string(missing) + " of " + std::to_string(count) +
                       (missing == 1 ? " cases is" : " cases are") + " missing: number ";
    const std::size_t wanted = std::min(missing, kMostNamed);
    for (std::size_t i = 0, named = 0; named < wanted; ++i)
        if (!found.contains(i)) text += (named++ == 0 ? "" : ", ") + std::to_string(i);
    return text + (missing > wanted ? " ..." : "") + " of the sweep, counted from 0";
}

scene::Json
merged(std::vector<Part> parts, const MergeRules& rules, std::vector<std::string>& notes) {
    Judge judge(rules.force, notes);
    const Part& first = parts.front();
    for (const Part& part : parts)
        if (const auto difference = identityDifference(part.report, first.report))
            judge.object(part.path, *difference + ", as in " + first.path.string());

    bool interrupted = std::ranges::any_of(
        parts, [](const Part& part) { return part.report.value("interrupted", false); });
    const bool all_shards = areAllShards(parts);
    std::vector<scene::Json> cases = joinedCases(parts, rules.out, judge);
    scene::Json header = std::move(parts.front().report);
    if (header.contains("case_count")) {
        const auto count = header["case_count"].get<std::size_t>();
        const std::string missing = all_shards ? "" : missingText(cases, count);
        if (!missing.empty()) notes.push_back(missing);
        interrupted = !missing.empty();
    }
    header.erase("shard");
    // If the parts have different seeds, the whole has none.
    const scene::Json seed = header.value("order_seed", scene::Json());
    if (std::ranges::any_of(parts, [&](const Part& part) {
            return &part != &parts.front() &&
                   part.report.value("order_seed", scene::Json()) != seed;
        }))
        header.erase("order_seed");
    for (scene::Json& each : cases) report::putVerdict(header.at("environment"), each);
    return report::assembledReport(std::move(header), std::move(cases), interrupted);
}

}  // namespace

scene::Json mergedReport(
    const std::vector<fs::path>& reports, const MergeRules& rules,
    std::vector<std::string>& notes) {
    std::vector<Part> parts;
    for (const fs::path& path : reports) parts.push_back({path, report::readReport(path)});
    try {
        return merged(std::move(parts), rules, notes);
    } catch (const scene::Json::exception& error) {
        throw engine::Error("merge", "a report is damaged: " + scene::jsonReason(error));
    }
}

}  // namespace benchmarks::run
