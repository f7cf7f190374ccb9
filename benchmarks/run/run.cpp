#include "benchmarks/run/run.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <new>
#include <random>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/memory_need.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/table.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/record.h"
#include "benchmarks/scene/extensions.h"
#include "engine/error.h"
#include "engine/pictures.h"
#include "engine/process.h"

namespace benchmarks::run {

// ---- A case -------------------------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

// ---- Picture of a case --------------------------------------------------------------------------

constexpr std::uint32_t kWidest = 480;  // px

// Averages squares of `factor` x `factor` pixels. Drops the remainder at the edges.
std::vector<std::uint8_t> shrunk(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    std::uint32_t factor) {
    std::vector<std::uint8_t> small;
    small.reserve(pixels.size() / factor / factor);
    for (std::uint32_t y = 0; y + factor <= height; y += factor)
        for (std::uint32_t x = 0; x + factor <= width; x += factor)
            for (std::uint32_t channel = 0; channel < 4; ++channel) {
                std::uint32_t sum = 0;
                for (std::uint32_t v = 0; v < factor; ++v)
                    for (std::uint32_t u = 0; u < factor; ++u)
                        sum += pixels[(std::size_t{y + v} * width + x + u) * 4 + channel];
                const std::uint32_t area = factor * factor;
                small.push_back(static_cast<std::uint8_t>((sum + area / 2) / area));
            }
    return small;
}

}  // namespace

std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index) {
    const std::uint32_t factor =
        std::min((width + kWidest - 1) / kWidest, std::max(height, std::uint32_t{1}));
    const std::filesystem::path file = std::filesystem::path(report.stem().string() + ".pictures") /
                                       (std::to_string(index) + ".png");
    engine::writePng(
        report.parent_path() / file, width / factor, height / factor,
        shrunk(pixels, width, height, factor));
    return file.generic_string();
}

namespace {

// ---- Pictures of older runs ---------------------------------------------------------------------

// "12.png", or the partial file of a run that was killed, "12.png.0123456789abcdef.partial". Other
// files belong to the user.
bool isCasePicture(const std::string& name) {
    const std::size_t digits = name.find_first_not_of("0123456789");
    return digits != 0 && digits != std::string::npos &&
           (name.substr(digits) == ".png" ||
            (name.substr(digits).starts_with(".png.") && name.ends_with(".partial")));
}

}  // namespace

void removeOtherPictures(const std::set<std::string>& pictures, const fs::path& report) {
    std::set<std::string> named;
    for (const std::string& each : pictures) named.insert(fs::path(each).filename().string());
    const fs::path folder = report.parent_path() / (report.stem().string() + ".pictures");
    std::error_code ignored;
    std::set<fs::path> stale;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (const std::string name = entry.path().filename().string();
            isCasePicture(name) && !named.contains(name))
            stale.insert(entry.path());
    for (const fs::path& file : stale) fs::remove(file, ignored);
    fs::remove(folder, ignored);  // if it is empty
}

namespace {

// ---- The case -----------------------------------------------------------------------------------

report::CaseResult emptyResult(const PlannedCase& planned) {
    return {.name = planned.spec.name, .index = planned.index, .axes = planned.spec.axes};
}

report::CaseResult without(const PlannedCase& planned, report::Status status, const char* reason) {
    report::CaseResult result = emptyResult(planned);
    result.status = status;
    result.reason = reason;
    return result;
}

// A failure to write the picture only adds a warning, because it does not affect the measurements.
void keepPicture(
    std::span<const std::uint8_t> pixels, const hair::RenderSettings& render,
    const std::filesystem::path& report, report::CaseResult& result) {
    try {
        result.picture =
            writeCasePicture(pixels, render.width, render.height, report, *result.index);
    } catch (const engine::Error& error) {
        result.trust.warnings.push_back(std::string("no picture: ") + error.what());
    }
}

}  // namespace

PlayedCase runCase(
    const engine::Device& device, const PlannedCase& planned, const measure::MeasureHooks& hooks,
    const std::filesystem::path& report, CaseComparisons& comparisons, measure::HairCache& cache,
    std::optional<std::uint64_t> max_memory) {
    const hair::RunSettings& run = planned.spec.settings.run;
    const hair::RenderSettings& render = planned.spec.settings.render;
    PlayedCase played{.result = emptyResult(planned)};
    report::CaseResult& result = played.result;
    std::optional<report::MemoryNeed> need;
    std::vector<report::ShaderRecord> shaders;
    device.pipelines().takePrograms();  // those of the case before
    try {
        const engine::TimeLimit limit(double{run.case_timeout}, "/run/case_timeout");
        need = measure::caseMemory(device, planned.spec.settings, planned.directory, &cache).need;
        if (const std::string reason =
                measure::whyItDoesNotFit(*need, measure::memoryRooms(device, max_memory));
            !reason.empty())
            throw engine::Unsupported(reason);
        measure::Case test_case(device, planned.spec.settings, planned.directory, &cache);
        measure::addShaderCosts(device.pipelines().takePrograms(), result);
        shaders = result.shaders;
        result.trust.warnings = test_case.warnings();
        for (const scene::NamedExtension& each : scene::namedExtensions(test_case.settings()))
            result.extensions.push_back({each.pointer, each.file, report::sha256(each.text)});
        const measure::ClockHold clocks(device.info(), run.clocks);
        const auto picture = measure::measure(device, test_case, run, hooks, result);
        if (!run.reference.empty())
            comparisons.references.add(
                planned.directory / run.reference, render.width, render.height, picture, result);
        if (run.compare_backends)
            comparisons.backends.add(device, test_case, planned.spec.settings, picture, result);
        if (!report.empty()) keepPicture(picture, render, report, result);
    } catch (const engine::Unsupported& error) {
        result = without(planned, report::Status::skipped, error.what());
    } catch (const engine::DeviceLost& error) {
        result = without(planned, report::Status::failed, error.what());
        played.lost_device = true;
    } catch (const engine::Error& error) {
        result = without(planned, report::Status::failed, error.what());
    } catch (const engine::TimedOut& over) {
        result = without(planned, report::Status::failed, over.reason.c_str());
    } catch (const std::bad_alloc&) {
        result = without(planned, report::Status::failed, "the host has not enough memory");
    }
    result.memory_need = need;
    result.shaders = std::move(shaders);  // also of a case that failed later
    for (const std::string& message : device.messages().take())
        result.trust.warnings.push_back("validation: " + message);
    return played;
}

// ---- The run ------------------------------------------------------------------------------------

namespace {

report::ReportHeader
headerOf(const RunOptions& options, const RunPlan& plan, const engine::Device& device) {
    report::ReportHeader header;
    header.environment = report::describeEnvironment(
        device, options.command, plan.seed, options.scene.device.validation);
    measure::addBoard(device.info(), header.environment.device);
    header.scene = plan.scene;
    header.case_count = plan.case_count;
    header.order_seed = options.order_seed ? *options.order_seed : std::random_device()();
    if (!options.shard.empty()) header.shard = parseShard(options.shard);
    return header;
}

// The reason for a run to end before its last case.
struct Ended {
    bool interrupted = false;  // by the user
    std::string no_device;  // why no device is left
};

// The work of other programs lengthens all frames of a device that shares the processors, so the
// run waits before each case. On another device it disturbs only the host's part, so the run waits
// once, before it begins.
void waitForOthers(
    const engine::Device& device, const hair::RunSettings& run, bool is_first,
    measure::QuietWait& quiet, measure::Progress& progress) {
    if (!is_first && !report::sharesProcessors(device.info().type)) return;
    progress.clear();
    quiet.wait(double{run.max_time});
}

Ended playCases(
    RunDevice& device, const RunPlan& plan, RunRecord& record,
    const std::filesystem::path& pictures_of, measure::HairCache& cache) {
    measure::Progress progress(plan.cases.size(), record.done());
    measure::DeviceKnowledge known;
    const measure::MeasureHooks hooks{
        .stop =
            [] {
                engine::checkInterrupted();
                return false;
            },
        .progress = [&](const measure::SamplingState& state) { progress.update(state); },
        .known = &known};
    CaseComparisons comparisons;
    measure::QuietWait quiet(measure::otherLoad, [](double share) {
        std::cerr << "other programs use " << report::shareText(share)
                  << " of the processors: waiting for them, at most "
                  << report::plainNumber(measure::kMostQuietWaits) << " s in all\n";
    });
    const std::size_t first = record.done();
    Ended ended;
    try {
        for (const auto& [place, order] : record.remaining()) {
            const PlannedCase& each = plan.cases[place];
            waitForOthers(
                device.get(), each.spec.settings.run, record.done() == first, quiet, progress);
            progress.begin(each.spec.name);
            PlayedCase played = runCase(
                device.get(), each, hooks, pictures_of, comparisons, cache, plan.max_memory);
            if (played.lost_device) device.drop();
            played.result.order = order;
            const engine::HeldMessages held;  // they write the record
            record.add(played.result);
        }
    } catch (const engine::Interrupted&) {
        ended.interrupted = true;
    } catch (const engine::NoDevice& error) {
        ended.no_device = error.what();
    } catch (...) {
        progress.clear();
        throw;
    }
    progress.clear();
    return ended;
}

// Writes the report. Returns what to say about it, and removes pictures of earlier runs once it is
// complete.
FinishedRun finishRun(RunRecord& record, const Ended& ended, const fs::path& out) {
    FinishedRun finished{
        .done = record.done(),
        .measured = record.measured(),
        .interrupted = ended.interrupted,
        .no_device = ended.no_device};
    const bool is_short = ended.interrupted || !ended.no_device.empty();
    report::CaseTable table(record.header());
    std::string warnings;
    std::set<std::string> pictures;  // files, relative to the report
    record.write(is_short ? RunEnd::interrupted : RunEnd::complete, [&](const scene::Json& each) {
        table.add(each);
        finished.verdicts.add(record.header().at("environment"), each);
        for (const scene::Json& warning :
             each.value("/trust/warnings"_json_pointer, scene::Json::array()))
            warnings +=
                engine::shownText(
                    each.at("name").get<std::string>() + ": " + warning.get<std::string>()) +
                '\n';
        if (each.contains("picture")) pictures.insert(each.at("picture").get<std::string>());
    });
    finished.summary = table.text() + '\n' + warnings;
    if (!is_short && record.hasJournal()) removeOtherPictures(pictures, out);
    return finished;
}

}  // namespace

const engine::Device& RunDevice::get() {
    if (device_) return *device_;
    try {
        device_.emplace(options_);
    } catch (const engine::Error& error) {
        if (had_one_) throw engine::NoDevice("no other device", error.what());
        throw;
    }
    had_one_ = true;
    return *device_;
}

std::filesystem::path reportFile(const RunOptions& options, const RunPlan& plan) {
    if (!options.out.empty()) return options.out;
    std::string name = plan.name;
    if (!options.shard.empty()) {
        const report::Shard shard = parseShard(options.shard);
        name += '.' + std::to_string(shard.index) + "of" + std::to_string(shard.count);
    }
    return std::filesystem::path("results/local") / (name + ".json");
}

void checkReferences(const RunPlan& plan) {
    for (const PlannedCase& each : plan.cases) {
        const std::string& file = each.spec.settings.run.reference;
        if (!file.empty() && !std::filesystem::is_regular_file(each.directory / file))
            throw engine::Error(
                plan.scene.path,
                "/run/reference: " + (each.directory / file).string() + ": is not a file");
    }
}

FinishedRun playRun(
    RunDevice& device, const RunOptions& options, const RunPlan& plan,
    const std::filesystem::path& out, measure::HairCache& cache,
    const std::function<void(const FinishedRun&)>& last_words) {
    const report::ReportHeader header = headerOf(options, plan, device.get());
    if (options.resume)
        if (const auto measured = measuredInComplete(plan, header, out))
            return {
                .verdicts = report::verdictsOf(report::readReport(out)),
                .done = plan.cases.size(),
                .measured = *measured,
                .was_complete = true};
    RunRecord record(
        plan, header, {.out = out, .filter = options.filter, .resume = options.resume});
    if (record.done() > 0)
        std::cerr << "continuing after " << record.done() << " of " << plan.cases.size()
                  << " cases\n";
    const bool keeps_pictures = options.pictures && record.hasJournal();
    Ended ended;
    {
        const engine::InterruptMessage words(
            [&] { last_words(finishRun(record, {.interrupted = true}, out)); });
        ended =
            playCases(device, plan, record, keeps_pictures ? out : std::filesystem::path(), cache);
        engine::finishInAnyCase();
    }
    return finishRun(record, ended, out);
}

// ---- Merging of reports -------------------------------------------------------------------------

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
