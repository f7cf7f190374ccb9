#include "benchmarks/run/plan.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <iostream>
#include <iterator>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/memory_need.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/pattern.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/frame_loop.h"
#include "engine/hazards.h"
#include "engine/process.h"
#include "hair/groom/growth/roots.h"
#include "hair/rendering/strand_plan.h"
#include "hair/simulation/probes.h"
#include "hair/simulation/solvers.h"

namespace benchmarks::run {
namespace {

// ---- Plan ---------------------------------------------------------------------------------------

report::SceneRecord recordOf(const std::filesystem::path& path, scene::Document document) {
    std::string hash = report::hashText(document.text());
    return {
        .path = path.generic_string(), .hash = std::move(hash), .document = std::move(document)};
}

bool readNumber(std::string_view text, std::uint32_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

scene::Document documentOf(const scene::CaseSpec& spec) {
    return scene::Document(scene::writeSettings(spec.settings));
}

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
    RunPlan plan{.name = options.scene.stem().string(), .seed = scenes.front().settings.seed};
    scene::Json documents = scene::Json::object();
    std::string all_documents;
    std::vector<PlannedCase> cases;
    for (scene::Scene& scene : scenes) {
        for (scene::CaseSpec& spec : scene::selectCases(scene, options, assets)) {
            all_documents += spec.name + '\n' + documentOf(spec).text() + '\n';
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

namespace {

std::string joined(const std::set<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

// Returns the passes of a frame that has others in flight before it.
std::vector<engine::PassUses>
passesOf(const engine::Device& device, const PlannedCase& planned, measure::HairCache& cache) {
    constexpr int kFrames = 3;
    measure::Case played(device, planned.spec.settings, planned.directory, &cache);
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    engine::HazardLog& log = *device.hazards();
    log.keepRecordings();
    for (int i = 0; i < kFrames; ++i) {
        log.takeRecordings();
        loop.frame([&](engine::Passes& passes) { played.frame(passes); });
    }
    std::vector<engine::PassUses> passes;
    for (const engine::Recording& recording : log.takeRecordings())
        std::ranges::copy(log.passesOf(recording), std::back_inserter(passes));
    loop.finish();
    return passes;
}

}  // namespace

int printPasses(const RunPlan& plan, engine::DeviceOptions options, measure::HairCache& cache) {
    options.keeps_uses = true;
    const engine::Device device(options);
    bool is_any = false;
    for (const PlannedCase& each : plan.cases) {
        std::cout << each.spec.name << '\n';
        try {
            std::uint32_t barriers = 0;
            for (const engine::PassUses& pass : passesOf(device, each, cache)) {
                std::cout << "  " << pass.pass << "\n    barriers " << pass.barriers << "\n"
                          << "    reads " << joined(pass.reads) << '\n'
                          << "    writes " << joined(pass.writes) << '\n';
                barriers += pass.barriers;
            }
            std::cout << "  all barriers: " << barriers << '\n';
            is_any = true;
        } catch (const engine::Unsupported& error) {
            std::cout << "  " << engine::shownText(error.what()) << '\n';
        }
    }
    return is_any ? report::kOk : report::kNothingRan;
}

// ---- Estimates ----------------------------------------------------------------------------------

namespace {

using Clock = std::chrono::steady_clock;

// ---- Work ---------------------------------------------------------------------------------------

constexpr std::uint32_t kThesisGuides = 86;  // if the scene gives no number
// For a file whose points are not counted yet.
constexpr std::uint32_t kUncountedVertices = 16;

// Upper limits of a case that is tried unchanged on a software device.
constexpr FrameWork kSmall{.updates = 200'000.0, .segments = 200'000.0, .samples = 400'000.0};
constexpr double kSmallSettling = 5e6;  // updates

// Upper limits of a case that is made smaller.
constexpr std::uint32_t kMostStrands = 300;
constexpr std::uint32_t kMostGuides = 172;
constexpr std::uint32_t kMostGrownGuides = 20'000;  // the processor grows them, whatever the device
constexpr std::uint32_t kMostDensity = 4;  // per root triangle
constexpr double kMostSamples = 200'000.0;  // samples of the picture
constexpr std::uint32_t kMostShadowResolution = 256;
constexpr std::uint32_t kMostEnvironmentLights = 2;
constexpr std::uint32_t kMostFieldResolution = 32;

// Number of shadow views of the hair or the meshes.
double shadowViews(const hair::Settings& settings) {
    const hair::ShadingSettings& shading = settings.shading;
    if (!shading.shadows.meshes && !hair::hasHairMaps(shading.shadows)) return 0.0;
    double views = settings.render.environment.empty() ? 0.0 : shading.environment_lights;
    for (const hair::LightSettings& light : shading.lights)
        if (light.shadows) views += light.shadow_samples;
    return views;
}

double samplesOf(const hair::RenderSettings& render) {
    return double(render.width) * render.height * render.ssaa * render.ssaa * render.msaa;
}

}  // namespace

FrameWork frameWork(const hair::Settings& settings) {
    const hair::GroomSettings& groom = settings.groom;
    const double guides = groom.guides == 0 ? kThesisGuides : groom.guides;
    const std::uint32_t grown = groom.file.empty() ? groom.grow.vertices : kUncountedVertices;
    const double vertices = groom.vertices == 0 ? grown : groom.vertices;
    const double views = shadowViews(settings);
    const double shadow_texels =
        double(settings.shading.shadows.resolution) * settings.shading.shadows.resolution;
    FrameWork work{.samples = samplesOf(settings.render) + views * shadow_texels};
    const hair::SimulationSettings& simulation = settings.simulation;
    if (simulation.solver != hair::Solver::none)
        work.updates = guides * vertices * hair::simulation::stepOf(simulation).count *
                       std::max(1.0, double{settings.run.frame_time} / simulation.time_step);
    if (settings.render.hair) {
        const float level = settings.lod.mode == hair::LodMode::forced ? settings.lod.level : 0.0f;
        const float scale = std::exp2(-level);
        // Euler's formula for a triangulated disc: 2 guides - 2 - (guides on the edge) triangles.
        const double triangles = std::max(
            1.0, 2.0 * guides - 2.0 - hair::groom::boundaryRootCount(std::uint32_t(guides)));
        const double all =
            settings.strands.source == hair::StrandSource::groom
                ? std::max<double>(groom.grow.strands, guides) * scale
                : triangles * hair::rendering::drawnStrands(settings.strands.density, scale);
        work.segments = (hair::hasHairMaps(settings.shading.shadows) ? 1.0 + views : 1.0) * all *
                        (vertices - 1.0) *
                        hair::rendering::drawnPieces(settings.strands.tessellation, scale).count;
    }
    return work;
}

bool isSmall(const hair::Settings& settings, double speed) {
    const FrameWork work = frameWork(settings);
    return work.updates <= speed * kSmall.updates && work.segments <= speed * kSmall.segments &&
           work.samples <= speed * kSmall.samples &&
           settings.simulation.settle_steps * work.updates <= speed * kSmallSettling &&
           settings.groom.grow.strands <= kMostStrands &&
           settings.groom.guides <= kMostGrownGuides &&
           std::ranges::all_of(settings.simulation.distance_fields, [&](const auto& field) {
               return field.resolution <= kMostFieldResolution || speed > 1.0;
           });
}

hair::Settings smaller(const hair::Settings& settings) {
    hair::Settings small = settings;
    small.groom.grow.strands = std::min(small.groom.grow.strands, kMostStrands);
    small.groom.guides = std::min(small.groom.guides, kMostGuides);
    small.strands.density = std::min(small.strands.density, kMostDensity);
    if (const double samples = samplesOf(small.render); samples > kMostSamples) {
        const double shrink = std::sqrt(kMostSamples / samples);
        for (std::uint32_t* side : {&small.render.width, &small.render.height})
            *side = std::max(1u, static_cast<std::uint32_t>(shrink * *side));
    }
    hair::ShadingSettings& shading = small.shading;
    shading.environment_lights = std::min(shading.environment_lights, kMostEnvironmentLights);
    shading.shadows.resolution = std::min(shading.shadows.resolution, kMostShadowResolution);
    small.simulation.settle_steps = 0;
    small.simulation.rest = hair::RestShape::groom;
    for (hair::DistanceFieldSettings& field : small.simulation.distance_fields)
        field.resolution = std::min(field.resolution, kMostFieldResolution);
    for (hair::PullSettings& pull : small.simulation.pulls) pull.guide = 0;  // there may be no more
    return small;
}

CaseKind kindOf(const hair::Settings& settings) {
    return {settings.strands.backend, settings.shading.model, settings.simulation.solver};
}

double mostTimesLonger(const FrameWork& of, const FrameWork& tried) {
    const auto ratio = [](double a, double b) { return a / std::max(b, 1.0); };
    return std::max(
        {ratio(of.updates, tried.updates), ratio(of.segments, tried.segments),
         ratio(of.samples, tried.samples)});
}

namespace {

// ---- Cases that are tried -----------------------------------------------------------------------

// Overlapped, isolated, and by the CPU's clock where timestamps are not trusted.
constexpr double kModes = 3;
// Share of /run/max_time for the check of the timestamps.
constexpr double kCheckShare = 0.1;
// Number of frames that cost as much as the pictures of /run/compare_backends: one of 64 samples
// per pixel, one by tessellation, and two for the covered samples.
constexpr double kComparisonFrames = 67;

// Speed of any GPU relative to a software device.
constexpr double kDeviceSpeed = 100.0;

// After the first trial, new trials start within this time.
constexpr std::chrono::seconds kTrials{4};

struct Estimate {
    std::optional<double> frame;  // ms
    double creation = 0.0;  // s, including the first frame
    std::optional<std::uint64_t> bytes;  // of the device's memory
    bool was_tried = false;  // unchanged, not made smaller
    std::string problem;
};

struct Trial {
    CaseKind kind;
    FrameWork work;
    double frame = 0.0;  // ms, of the second frame: the first one compiles pipelines
    double creation = 0.0;  // s, including the first frame
};

// Creates the case and draws two frames. Sets the memory that it holds on the device.
Trial tryFrames(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, measure::HairCache& cache, std::uint64_t& bytes) {
    const Clock::time_point begin = Clock::now();
    measure::Case test_case(device, settings, directory, &cache);
    engine::FrameLoop loop(device, engine::Timing::isolated);
    Trial trial{.kind = kindOf(settings), .work = frameWork(settings)};
    for (int i = 0; i < 2; ++i) {
        engine::checkInterrupted();
        loop.frame([&](engine::Passes& passes) { test_case.frame(passes); });
        if (i == 0) trial.creation = std::chrono::duration<double>(Clock::now() - begin).count();
    }
    const engine::FrameRecord frame = loop.finish().back();
    trial.frame = frame.record + frame.wall;
    bytes = device.allocatedBytes();
    return trial;
}

// Returns an upper bound in seconds for measuring a case that exists: every mode takes
// /run/max_time without reaching the precision, the check of the timestamps takes its longest and
// fails, and every reference picture has to be drawn. `frame_ms` is the time of one frame.
double mostSeconds(const hair::RunSettings& run, double frame_ms) {
    const double round = (run.warmup + run.frames + 1) * frame_ms / 1e3;
    // A round may start until max_time and is then finished.
    const double mode = double{run.max_time} + round;
    const double compared = run.compare_backends ? round + kComparisonFrames * frame_ms / 1e3 : 0.0;
    const double probed = hair::simulation::hasProbes(run.probes) ? round : 0.0;
    return kModes * mode + kCheckShare * double{run.max_time} + compared + probed;
}

class Trials {
public:
    Trials(const RunPlan& plan, const engine::Device& device, measure::HairCache& cache)
        : plan_(plan), device_(device), cache_(cache),
          speed_(device.info().type == engine::DeviceType::cpu ? 1.0 : kDeviceSpeed),
          estimates_(plan.cases.size()) {
        findNeeds();
    }

    // Tries cases until the time is up. Throws Interrupted.
    void play();
    // Estimates from the trials the cases that were not tried.
    void estimateOthers();

    const std::vector<Estimate>& estimates() const { return estimates_; }
    std::size_t tried() const {
        return static_cast<std::size_t>(
            std::ranges::count_if(estimates_, [](const Estimate& each) { return each.was_tried; }));
    }

private:
    const hair::Settings& settings(std::size_t place) const {
        return plan_.cases[place].spec.settings;
    }
    // Collects what is known of all cases before any is created.
    void findNeeds();
    bool fits(std::size_t place) const { return estimates_[place].problem.empty(); }
    enum class Size { whole, smaller };
    void tryCase(std::size_t place, Size size);

    const RunPlan& plan_;
    const engine::Device& device_;
    measure::HairCache& cache_;
    double speed_;
    std::vector<Estimate> estimates_;
    std::vector<Trial> trials_;
};

void Trials::findNeeds() {
    const std::vector<measure::MemoryRoom> rooms = measure::memoryRooms(device_, plan_.max_memory);
    for (std::size_t place = 0; place < estimates_.size(); ++place) {
        engine::checkInterrupted();
        try {
            const report::MemoryNeed need =
                measure::caseMemory(device_, settings(place), plan_.cases[place].directory, &cache_)
                    .need;
            estimates_[place].bytes = need.device;
            estimates_[place].problem = measure::whyItDoesNotFit(need, rooms);
        } catch (const engine::Unsupported& error) {
            estimates_[place] = {.was_tried = true, .problem = error.what()};
        }
    }
}

void Trials::tryCase(std::size_t place, Size size) {
    const std::string name = plan_.cases[place].spec.name;
    const engine::Step step((size == Size::whole ? "tries " : "tries a smaller ") + name);
    Estimate& estimate = estimates_[place];
    const hair::Settings settings =
        size == Size::whole ? this->settings(place) : smaller(this->settings(place));
    std::uint64_t bytes = 0;
    try {
        const Trial trial =
            tryFrames(device_, settings, plan_.cases[place].directory, cache_, bytes);
        trials_.push_back(trial);
        if (size == Size::smaller) return;
        estimate = {
            .frame = trial.frame, .creation = trial.creation, .bytes = bytes, .was_tried = true};
    } catch (const engine::Unsupported& error) {
        estimate = {.was_tried = true, .problem = error.what()};
    } catch (const engine::Error& error) {
        // A smaller case may lack something that this one needs, like a guide that is pulled.
        if (size == Size::whole) estimate = {.was_tried = true, .problem = error.what()};
    }
}

void Trials::play() {
    std::vector<std::size_t> order(estimates_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto work = [&](std::size_t place) { return frameWork(settings(place)); };
    const auto all = [&](std::size_t place) {
        return work(place).updates + work(place).segments + work(place).samples;
    };
    std::ranges::stable_sort(order, {}, all);
    // Starts after the first trial, which compiles the shared pipelines.
    std::optional<Clock::time_point> start;
    const auto is_over = [&] { return start && Clock::now() > *start + kTrials; };
    const auto try_case = [&](std::size_t place, Size size) {
        tryCase(place, size);
        if (!start) start = Clock::now();
    };

    std::erase_if(order, [&](std::size_t place) { return !fits(place); });
    if (order.empty()) return;

    // Cases with the most work of a kind, made smaller, predict large cases better than small cases
    // do.
    std::set<std::size_t> largest;
    for (double FrameWork::* const part :
         {&FrameWork::segments, &FrameWork::updates, &FrameWork::samples})
        largest.insert(
            *std::ranges::max_element(order, {}, [&](std::size_t i) { return work(i).*part; }));
    for (const std::size_t place : largest) {
        if (isSmall(settings(place), speed_) || (is_over() && !trials_.empty())) continue;
        try_case(place, Size::smaller);
    }
    std::set<CaseKind> kinds;  // kinds with a trial that succeeded or failed
    for (const Trial& trial : trials_) kinds.insert(trial.kind);
    for (const std::size_t place : order) {
        if (kinds.insert(kindOf(settings(place))).second)
            try_case(place, isSmall(settings(place), speed_) ? Size::whole : Size::smaller);
    }
    for (const std::size_t place : order) {
        if (estimates_[place].was_tried) continue;
        const bool small = isSmall(settings(place), speed_);
        // Unsupported cases leave no trial, so a large case is tried if there is none yet.
        if (is_over() || (!small && !trials_.empty())) break;
        try_case(place, small ? Size::whole : Size::smaller);
    }
}

void Trials::estimateOthers() {
    for (std::size_t place = 0; place < estimates_.size(); ++place) {
        Estimate& estimate = estimates_[place];
        if (estimate.was_tried || !fits(place)) continue;
        const FrameWork work = frameWork(settings(place));
        const CaseKind kind = kindOf(settings(place));
        // Each trial of its kind gives an upper bound.
        for (const Trial& trial : trials_) {
            if (trial.kind != kind) continue;
            const double longer = std::max(1.0, mostTimesLonger(work, trial.work));
            const double frame = trial.frame * longer;
            if (estimate.frame && *estimate.frame <= frame) continue;
            estimate.frame = frame;
            // A settling step is a part of a frame. Smaller cases are created without settling.
            estimate.creation =
                trial.creation * longer + settings(place).simulation.settle_steps * frame / 1e3;
        }
    }
}

// ---- Table --------------------------------------------------------------------------------------

void print(const RunPlan& plan, const Trials& trials) {
    std::vector<report::Column> columns(5);
    columns[0] = {.title = "case", .numeric = false};
    columns[1] = {.title = "memory"};
    columns[2] = {.title = "frame ms"};
    columns[3] = {.title = "at most s"};
    columns[4] = {.title = "", .numeric = false};
    double seconds = 0.0;
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < plan.cases.size(); ++i) {
        const Estimate& each = trials.estimates()[i];
        const std::string bound = each.was_tried ? "" : "at most ";
        std::optional<double> most;
        if (each.frame)
            most = each.creation + mostSeconds(plan.cases[i].spec.settings.run, *each.frame);
        columns[0].cells.push_back(plan.cases[i].spec.name);
        columns[1].cells.push_back(each.bytes ? bound + report::sizeText(*each.bytes) : "-");
        columns[2].cells.push_back(each.frame ? bound + report::shortNumber(*each.frame) : "-");
        columns[3].cells.push_back(most ? report::shortNumber(*most) : "-");
        columns[4].cells.push_back(each.problem);
        seconds += most.value_or(0.0);
        if (each.problem.empty()) bytes = std::max(bytes, each.bytes.value_or(0));
    }
    std::cout << report::columnsText(columns);
    const std::size_t count = plan.cases.size();
    const std::size_t tried = trials.tried();
    std::cout << count << (count == 1 ? " case, " : " cases, ");
    if (bytes > 0) std::cout << "at most " << report::sizeText(bytes) << " at a time, ";
    if (seconds > 0.0)
        std::cout << "at most " << report::shortNumber(seconds / 60.0) << " min\n";
    else
        std::cout << "none of which could be tried\n";
    if (tried < count && seconds > 0.0)
        std::cout
            << tried
            << " of them tried; the times of the others are estimated from smaller cases of "
               "the same back end, shading and solver by counts of guides, strands and samples, "
               "and their memory by the sizes of their data\n";
}

}  // namespace

int estimateRun(
    const RunPlan& plan, const engine::DeviceOptions& options, measure::HairCache& cache) {
    std::optional<engine::Device> device;
    try {
        device.emplace(options);
    } catch (const engine::NoDevice& error) {
        std::cerr << "hairbench: no estimates: " << engine::shownText(error.what()) << '\n';
        return printNames(plan);
    }
    Trials trials(plan, *device, cache);
    int status = report::kOk;
    try {
        trials.play();
    } catch (const engine::Interrupted&) {
        status = report::kInterrupted;
    }
    trials.estimateOthers();
    print(plan, trials);
    return status;
}

}  // namespace benchmarks::run
