#include "benchmarks/run/run.h"

#include <iostream>
#include <optional>
#include <random>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/measure/quiet_wait.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/table.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/run/case.h"
#include "benchmarks/run/record.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/process.h"
#include "engine/shown_text.h"

namespace benchmarks::run {
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

FinishedRun finishedRun(const RunRecord& record) {
    const report::EachCase each_case = [&](const auto& visit) { record.eachCase(visit); };
    FinishedRun finished{
        .summary = report::table(record.header(), each_case) + '\n',
        .done = record.done(),
        .measured = record.measured()};
    record.eachCase([&](const scene::Json& each) {
        finished.verdicts.add(record.header().at("environment"), each);
        for (const scene::Json& warning :
             each.value("/trust/warnings"_json_pointer, scene::Json::array()))
            finished.summary +=
                engine::shownText(
                    each.at("name").get<std::string>() + ": " + warning.get<std::string>()) +
                '\n';
    });
    return finished;
}

// Returns the picture files, relative to the report.
std::set<std::string> picturesOf(const RunRecord& record) {
    std::set<std::string> pictures;
    record.eachCase([&](const scene::Json& each) {
        if (each.contains("picture")) pictures.insert(each.at("picture").get<std::string>());
    });
    return pictures;
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
                .summary = {},
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
    const auto finish = [&](const Ended& ended) {
        const bool is_short = ended.interrupted || !ended.no_device.empty();
        FinishedRun finished = finishedRun(record);
        finished.interrupted = ended.interrupted;
        finished.no_device = ended.no_device;
        const std::set<std::string> pictures = picturesOf(record);
        record.write(is_short ? RunEnd::interrupted : RunEnd::complete);
        if (!is_short && record.hasJournal()) removeOtherPictures(pictures, out);
        return finished;
    };
    Ended ended;
    {
        const engine::InterruptMessage words([&] { last_words(finish({.interrupted = true})); });
        ended =
            playCases(device, plan, record, keeps_pictures ? out : std::filesystem::path(), cache);
    }
    return finish(ended);
}

}  // namespace benchmarks::run
