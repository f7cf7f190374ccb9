#include "benchmarks/run/run.h"

#include <iostream>
#include <optional>
#include <random>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/progress.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/case.h"
#include "benchmarks/run/record.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/process.h"

namespace benchmarks::run {
namespace {

report::ReportHeader
headerOf(const RunOptions& options, const RunPlan& plan, const engine::Device& device) {
    report::ReportHeader header;
    header.environment = report::describeEnvironment(
        device, options.command, plan.seed, options.scene.device.validation);
    header.scene = plan.scene;
    header.case_count = plan.case_count;
    header.order_seed = options.order_seed ? *options.order_seed : std::random_device()();
    if (!options.shard.empty()) header.shard = parseShard(options.shard);
    return header;
}

// Whether the user stopped it before the last case.
bool playCases(
    const engine::Device& device, const RunPlan& plan, RunRecord& record,
    const std::filesystem::path& pictures_of, measure::HairCache& cache) {
    measure::Progress progress(plan.cases.size(), record.done());
    measure::DeviceKnowledge known;
    const measure::MeasureHooks hooks{
        .stop = engine::interrupted,
        .progress = [&](const measure::SamplingState& state) { progress.update(state); },
        .known = &known};
    CaseComparisons comparisons;
    bool interrupted = false;
    try {
        for (const auto& [place, order] : record.remaining()) {
            const PlannedCase& each = plan.cases[place];
            progress.begin(each.spec.name);
            report::CaseResult result =
                runCase(
                    device, each, hooks, pictures_of, comparisons, cache, plan.max_memory);
            result.order = order;
            record.add(result);
        }
    } catch (const engine::Interrupted&) {
        interrupted = true;
    } catch (...) {
        progress.clear();
        throw;
    }
    progress.clear();
    return interrupted;
}

FinishedRun finishedRun(const RunRecord& record) {
    const report::EachCase each_case = [&](const auto& visit) { record.eachCase(visit); };
    FinishedRun finished{
        .summary = report::table(record.header(), each_case) + '\n',
        .done = record.done(),
        .measured = record.measured()};
    record.eachCase([&](const scene::Json& each) {
        for (const scene::Json& warning :
             each.value("/trust/warnings"_json_pointer, scene::Json::array()))
            finished.summary +=
                each.at("name").get<std::string>() + ": " + warning.get<std::string>() + '\n';
    });
    return finished;
}

// Files relative to the report.
std::set<std::string> picturesOf(const RunRecord& record) {
    std::set<std::string> pictures;
    record.eachCase([&](const scene::Json& each) {
        if (each.contains("picture")) pictures.insert(each.at("picture").get<std::string>());
    });
    return pictures;
}

}  // namespace

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
                "/run/reference: " + (each.directory / file).string() + ": is no file");
    }
}

FinishedRun playRun(
    const engine::Device& device, const RunOptions& options, const RunPlan& plan,
    const std::filesystem::path& out, measure::HairCache& cache,
    const std::function<void(const FinishedRun&)>& last_words) {
    const report::ReportHeader header = headerOf(options, plan, device);
    if (options.resume)
        if (const auto measured = measuredInComplete(plan, header, out))
            return {
                .summary = {},
                .done = plan.cases.size(),
                .measured = *measured,
                .was_complete = true};
    RunRecord record(
        plan, header, {.out = out, .filter = options.filter, .resume = options.resume});
    if (record.done() > 0)
        std::cerr << "going on after " << record.done() << " of " << plan.cases.size()
                  << " cases\n";
    const bool keeps_pictures = options.pictures && record.hasJournal();
    const auto finish = [&](bool interrupted) {
        FinishedRun finished = finishedRun(record);
        finished.interrupted = interrupted;
        const std::set<std::string> pictures = picturesOf(record);
        record.write(interrupted ? RunEnd::interrupted : RunEnd::complete);
        if (!interrupted && record.hasJournal()) removeOtherPictures(pictures, out);
        return finished;
    };
    bool interrupted = false;
    {
        const engine::LastWords words([&] { last_words(finish(true)); });
        interrupted =
            playCases(device, plan, record, keeps_pictures ? out : std::filesystem::path(), cache);
    }
    return finish(interrupted);
}

}  // namespace benchmarks::run
