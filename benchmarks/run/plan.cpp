#include "benchmarks/run/plan.h"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <numeric>
#include <random>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/pattern.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"

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
        throw engine::Error(
            "--shard", "'" + text + "' is not I/N, as in 2/8 for the second of eight parts");
    if (shard.index < 1 || shard.index > shard.count)
        throw engine::Error(
            "--shard", "'" + text + "': the part must be from 1 to the number of parts");
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
    std::mt19937 random(seed);  // the standard fixes its numbers, but not those of distributions
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    return order;
}

int printNames(const RunPlan& plan) {
    for (const PlannedCase& each : plan.cases) std::cout << each.spec.name << '\n';
    std::cout << plan.cases.size() << (plan.cases.size() == 1 ? " case\n" : " cases\n");
    return report::kOk;
}

}  // namespace benchmarks::run
