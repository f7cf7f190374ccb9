#include "benchmarks/run/plan.h"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <numeric>
#include <optional>
#include <random>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/pattern.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "engine/process.h"

namespace benchmarks::run {
namespace {

// ---- Plan ---------------------------------------------------------------------------------------

report::SceneRecord recordOf(const std::filesystem::path& path, scene::Document document) {
    std::string hash = report::hashText(document.text());
    return {.path = path.string(), .hash = std::move(hash), .document = std::move(document)};
}

bool readNumber(std::string_view text, std::uint32_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

report::Shard parseShard(const std::string& text) {
    report::Shard shard;
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos ||
        !readNumber(std::string_view(text).substr(0, slash), shard.index) ||
        !readNumber(std::string_view(text).substr(slash + 1), shard.count))
        throw engine::Error("--shard", "'" + text + "' is not as 2/8: the second of eight parts");
    if (shard.index < 1 || shard.index > shard.count)
        throw engine::Error(
            "--shard", "'" + text + "': the part is between 1 and the number of parts");
    return shard;
}

namespace {

scene::Pattern filterOf(const std::string& regex) {
    try {
        return scene::Pattern(regex);
    } catch (const engine::Error& error) {
        throw engine::Error("--filter " + regex, error.what());
    }
}

}  // namespace

RunPlan planRun(
    const scene::SceneOptions& options, const std::string& filter, const std::string& shard_text,
    scene::AssetStore* assets) {
    const report::Shard shard = shard_text.empty() ? report::Shard{} : parseShard(shard_text);
    std::vector<scene::Scene> scenes = scene::loadScenes(options.scene, options.outside);
    RunPlan plan{
        .name = options.scene.stem().string(), .scene = {}, .seed = scenes.front().settings.seed};
    scene::Json documents = scene::Json::object();
    std::string all_documents;
    std::vector<PlannedCase> cases;
    for (scene::Scene& scene : scenes) {
        for (scene::CaseSpec& spec : scene::selectCases(scene, options, assets)) {
            all_documents += spec.name + '\n' + scene::caseDocument(scene, spec.axes).text() + '\n';
            const std::size_t index = cases.size();
            cases.push_back(
                {.spec = std::move(spec), .directory = scene.directory, .index = index});
        }
        documents[scene.name] = scene.resolved.json();
    }
    plan.scene = scene::isSuite(options.scene)
                     ? recordOf(options.scene, scene::Document(scene::Json{{"suite", documents}}))
                     : recordOf(options.scene, scenes.front().resolved);
    plan.case_count = cases.size();
    plan.cases_hash = report::hashText(all_documents);
    const scene::Pattern wanted = filterOf(filter);
    for (PlannedCase& each : cases)
        if (each.index % shard.count == shard.index - 1 && wanted.isIn(each.spec.name))
            plan.cases.push_back(std::move(each));
    return plan;
}

std::vector<std::size_t> shuffledOrder(std::size_t count, std::uint32_t seed) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 random(seed);  // whose numbers the standard fixes, unlike those of distributions
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

namespace {

// ---- Estimate of memory and time ----------------------------------------------------------------

// Overlapped, isolated, and by the CPU's clock where timestamps are not trusted.
constexpr double kModes = 3;
// Of /run/max_time, for the check of the timestamps.
constexpr double kCheckShare = 0.1;
// Pictures of /run/compare_backends: one of 64 samples a pixel, tessellation's and two of what is
// covered.
constexpr double kComparisonFrames = 67;

struct Estimate {
    double frame = 0.0;  // ms
    double seconds = 0.0;  // that measuring may take
    std::uint64_t bytes = 0;
    std::string problem;  // why there is none
};

// The second frame: the first one compiles pipelines.
double frameTime(const engine::Device& device, measure::Case& test_case) {
    engine::FrameLoop loop(device, engine::Timing::isolated);
    for (int i = 0; i < 2; ++i) {
        engine::checkInterrupted();
        loop.frame([&](engine::Passes& passes) { test_case.frame(passes); });
    }
    const engine::FrameRecord frame = loop.finish().back();
    return frame.record + frame.wall;
}

// Seconds that measuring a case takes if its median is not known well enough before /run/max_time,
// its timestamps are tested as long as they may be and are not trusted in the end, and every
// picture that it is compared with has to be drawn. Making the case is not in it. `frame_ms`: of
// one frame.
double mostSeconds(const hair::RunSettings& run, double frame_ms) {
    const double round = (run.warmup + run.frames + 1) * frame_ms / 1e3;
    // Rounds begin until max_time; the last one is played to its end.
    const double mode = double{run.max_time} + round;
    const double compared = run.compare_backends ? round + kComparisonFrames * frame_ms / 1e3 : 0.0;
    return kModes * mode + kCheckShare * double{run.max_time} + compared;
}

Estimate
estimateCase(const engine::Device& device, const PlannedCase& planned, measure::HairCache& cache) {
    try {
        const hair::Settings& settings = planned.spec.settings;
        measure::Case test_case(device, settings, planned.directory, &cache);
        const double frame = frameTime(device, test_case);
        return {
            .frame = frame,
            .seconds = mostSeconds(settings.run, frame),
            .bytes = device.allocatedBytes(),
            .problem = {}};
    } catch (const engine::Error& error) {
        return {.problem = error.what()};
    }
}

void print(const RunPlan& plan, const std::vector<Estimate>& estimates) {
    std::vector<report::Column> columns(5);
    columns[0] = {.title = "case", .numeric = false};
    columns[1] = {.title = "memory"};
    columns[2] = {.title = "frame ms"};
    columns[3] = {.title = "at most s"};
    columns[4] = {.title = "", .numeric = false};
    double seconds = 0.0;
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        const Estimate& each = estimates[i];
        const bool known = each.problem.empty();
        columns[0].cells.push_back(plan.cases[i].spec.name);
        columns[1].cells.push_back(known ? report::sizeText(each.bytes) : "-");
        columns[2].cells.push_back(known ? report::shortNumber(each.frame) : "-");
        columns[3].cells.push_back(known ? report::shortNumber(each.seconds) : "-");
        columns[4].cells.push_back(each.problem);
        seconds += each.seconds;
        bytes = std::max(bytes, each.bytes);
    }
    for (std::size_t row = 0; row <= estimates.size(); ++row)
        std::cout << report::columnsLine(columns, row);
    std::cout << estimates.size() << (estimates.size() == 1 ? " case" : " cases") << ", at most "
              << report::sizeText(bytes) << " at a time, at most "
              << report::shortNumber(seconds / 60.0) << " min\n";
}

}  // namespace

int printNames(const RunPlan& plan) {
    for (const PlannedCase& each : plan.cases) std::cout << each.spec.name << '\n';
    std::cout << plan.cases.size() << (plan.cases.size() == 1 ? " case\n" : " cases\n");
    return report::kOk;
}

int estimateRun(
    const RunPlan& plan, const engine::DeviceOptions& options, measure::HairCache& cache) {
    std::optional<engine::Device> device;
    try {
        device.emplace(options);
    } catch (const engine::NoDevice& error) {
        std::cerr << "hairbench: no estimates: " << error.what() << '\n';
        return printNames(plan);
    }
    engine::catchInterrupts();
    std::vector<Estimate> estimates;
    measure::Progress progress(plan.cases.size());
    try {
        for (const PlannedCase& each : plan.cases) {
            progress.begin(each.spec.name);
            estimates.push_back(estimateCase(*device, each, cache));
        }
    } catch (const engine::Interrupted&) {
        progress.clear();
        print(plan, estimates);
        return report::kInterrupted;
    }
    progress.clear();
    print(plan, estimates);
    return report::kOk;
}

}  // namespace benchmarks::run
