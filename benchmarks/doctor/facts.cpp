#include "benchmarks/doctor/facts.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <set>
#include <thread>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/commands.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/queries.h"
#include "engine/transfer.h"
#include "hair/groom/files.h"

namespace benchmarks::doctor {
namespace {

// ---- The doctor's scene -------------------------------------------------------------------------

constexpr std::uint32_t kGuides = 48;
constexpr std::uint32_t kVertices = 8;  // of a guide
constexpr double kDisc = 0.08;  // m, its radius
constexpr double kLength = 0.2;  // m, of a guide
constexpr double kLean = 0.6;  // outward lean of the outermost guides per metre down

}  // namespace

hair::groom::StrandSet doctorStrands() {
    // Successive roots turn by the golden angle, which gives a uniform density on the disc (Vogel
    // 1979, A better way to construct the sunflower head).
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    hair::groom::StrandSet strands;
    strands.metres_per_unit = 1.0;
    for (std::uint32_t guide = 0; guide < kGuides; ++guide) {
        const double out = std::sqrt((guide + 0.5) / kGuides);
        const double angle = golden_angle * guide;
        const double lean = kLean * out;
        const double step = kLength / (kVertices - 1) / std::sqrt(1.0 + lean * lean);
        for (std::uint32_t vertex = 0; vertex < kVertices; ++vertex) {
            const double down = step * vertex;
            const double radius = kDisc * out + lean * down;
            strands.points.emplace_back(
                radius * std::cos(angle), 0.1 - down, radius * std::sin(angle));
        }
        strands.ends.push_back((guide + 1) * kVertices);
    }
    return strands;
}

hair::Settings doctorSettings() {
    hair::Settings settings;
    settings.description = "A mop of hair in a gusty wind: what `hairbench doctor` measures.";
    settings.groom.file = kDoctorStrands;
    settings.simulation.substeps = 16;
    settings.simulation.wind.strength = 6.0f;
    settings.strands.density = 8;
    settings.strands.tessellation = 2;
    settings.camera.position = {0.0f, 0.05f, 0.3f};
    settings.camera.field_of_view = 60.0f;
    settings.render.width = 320;
    settings.render.height = 180;
    settings.run.frames = 10;
    return settings;
}

std::filesystem::path writeDoctorScene(const std::filesystem::path& folder) {
    hair::groom::exportStrands(doctorStrands(), folder / kDoctorStrands);
    const std::filesystem::path scene = folder / "doctor.json";
    engine::writeFileAtomically(scene, scene::writeSettings(doctorSettings()).dump(2) + '\n');
    return scene;
}

namespace {

// ---- Passes and pairs of equal runs -------------------------------------------------------------

constexpr int kPairs = 12;
constexpr int kRounds = 3;  // of isolated frames

// The cost of a round.
struct Cost {
    double frame;  // ms, median from one frame's start to the next one's
    double cpu;  // ms, of all threads of this process
};

Cost costOf(measure::RoundPlayer& player) {
    const engine::ProcessUse before = engine::processUse();
    std::vector<double> intervals;
    for (const engine::FrameRecord& frame : player.round()) intervals.push_back(frame.interval);
    return {report::summarize(intervals).median, (engine::processUse() - before).cpu};
}

}  // namespace

PassFacts examinePasses(const engine::Device& device, const measure::MeasureHooks& hooks) {
    const engine::ScratchFolder folder;
    writeDoctorScene(folder.path());
    const hair::Settings settings = doctorSettings();
    measure::Case test_case(device, settings, folder.path());
    measure::DeviceStage stage(device, test_case, settings.run, hooks);
    measure::RoundPlayer player(stage.player(engine::Timing::isolated), settings.run);
    // A busy machine only adds time outside the passes or between them. The round with the sum
    // nearest to the wall clock therefore tells most about the device.
    PassFacts facts;
    std::optional<measure::EmptySubmission> empty;
    double nearest = INFINITY;
    for (int i = 0; i < kRounds; ++i) {
        const std::vector<engine::FrameRecord> frames = player.round();
        if (!empty)
            empty = measure::measureEmptySubmission(
                stage, frames.back().device.value_or(frames.back().wall));
        const measure::PassSum sum = measure::passSums(frames, *empty);
        if (!sum.over_wall || std::abs(*sum.over_wall - 1.0) >= nearest) continue;
        nearest = std::abs(*sum.over_wall - 1.0);
        facts.sum = sum;
    }
    report::CaseResult result;
    facts.faults = measure::checkTimestamps(stage, result);
    return facts;
}

RepeatFacts examineRepeat(const engine::Device& device, const measure::MeasureHooks& hooks) {
    const engine::ScratchFolder folder;
    writeDoctorScene(folder.path());
    const hair::Settings settings = doctorSettings();
    measure::Case case_a(device, settings, folder.path());
    measure::Case case_b(device, settings, folder.path());
    measure::DeviceStage stage_a(device, case_a, settings.run, hooks);
    measure::DeviceStage stage_b(device, case_b, settings.run, hooks);
    measure::RoundPlayer a(stage_a.player(engine::Timing::overlapped), settings.run);
    measure::RoundPlayer b(stage_b.player(engine::Timing::overlapped), settings.run);
    // Warms up pipelines and caches.
    a.round();
    b.round();
    RepeatFacts facts;
    for (int pair = 0; pair < kPairs; ++pair) {
        const bool a_first = pair % 2 == 0;
        const Cost first = costOf(a_first ? a : b);
        const Cost second = costOf(a_first ? b : a);
        const double sign = a_first ? 1.0 : -1.0;
        facts.frame.push_back(sign * std::log(second.frame / first.frame));
        facts.cpu.push_back(sign * std::log(second.cpu / first.cpu));
    }
    const measure::RoundEnd end_a = a.lastEnd();
    const measure::RoundEnd end_b = b.lastEnd();
    facts.same_picture =
        end_a.picture_hash == a.firstEnd().picture_hash && end_a.picture_hash == end_b.picture_hash;
    facts.same_state =
        end_a.state_hash == a.firstEnd().state_hash && end_a.state_hash == end_b.state_hash;
    return facts;
}

// ---- Facts --------------------------------------------------------------------------------------

namespace {

namespace fs = std::filesystem;

// ---- Vulkan layers in this process --------------------------------------------------------------

// Most names follow the convention of the first; the others are common layers that do not.
constexpr std::array<std::string_view, 6> kMarks{"VkLayer",   "vkLayer",  "MangoHud",
                                                 "renderdoc", "vkbasalt", "overlayvulkanlayer"};

std::string_view fileName(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

}  // namespace

bool isLayerLibrary(std::string_view path) {
    const std::string_view name = fileName(path);
    return std::ranges::any_of(
        kMarks, [&](std::string_view mark) { return name.find(mark) != std::string_view::npos; });
}

std::vector<std::string> loadedLayers() {
    std::vector<std::string> layers;
    for (const std::string& library : engine::system::loadedLibraries())
        if (isLayerLibrary(library)) layers.emplace_back(fileName(library));
    return layers;
}

// ---- Resolution of timestamps -------------------------------------------------------------------

std::optional<TimestampSteps> timestampSteps(std::span<const std::uint64_t> ticks) {
    TimestampSteps steps;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        if (ticks[i] <= ticks[i - 1]) continue;
        const std::uint64_t difference = ticks[i] - ticks[i - 1];
        steps.step = std::gcd(steps.step, difference);
        steps.gap = steps.gap == 0 ? difference : std::min(steps.gap, difference);
    }
    if (steps.gap == 0) return std::nullopt;
    return steps;
}

std::optional<TimestampSteps> timestampSteps(const engine::Device& device) {
    if (device.info().timestamp_valid_bits == 0) return std::nullopt;
    constexpr std::uint32_t kTimestamps = 1000;
    engine::Timestamps timestamps(device, kTimestamps);
    runOnce(device, [&](engine::Commands& commands) {
        for (std::uint32_t i = 0; i < kTimestamps; ++i) timestamps.write(commands);
    });
    // Converts back to whole ticks; a double holds numbers of this size exactly.
    const double tick = double{device.info().limits.timestampPeriod} * 1e-6;  // ms
    std::vector<std::uint64_t> ticks;
    for (const double milliseconds : timestamps.read())
        ticks.push_back(static_cast<std::uint64_t>(std::llround(milliseconds / tick)));
    return timestampSteps(ticks);
}

namespace {

// ---- All facts ----------------------------------------------------------------------------------

// The load of other processes, measured for a second in which this process does nothing.
LoadFacts loadNow() {
    const auto before = measure::readProcessorTicks();
    const double own = engine::processUse().cpu;
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const auto after = measure::readProcessorTicks();
    if (!before || !after) return {};
    const auto load = measure::loadBetween(*before, *after, engine::processUse().cpu - own);
    if (!load) return {};
    return {.steal = load->steal, .others = load->others};
}

BuildFacts buildFacts() {
#ifdef NDEBUG
    constexpr bool kAssertions = false;
#else
    constexpr bool kAssertions = true;
#endif
    return {.build = report::describeBuild(), .assertions = kAssertions};
}

TimestampFacts timestampFacts(const engine::Device& device) {
    TimestampFacts facts{
        .valid_bits = device.info().timestamp_valid_bits,
        .period_ns = double{device.info().limits.timestampPeriod}};
    if (const auto steps = timestampSteps(device)) {
        facts.step_ns = static_cast<double>(steps->step) * facts.period_ns;
        facts.gap_ns = static_cast<double>(steps->gap) * facts.period_ns;
    }
    return facts;
}

ClockFacts clockFacts(const std::vector<measure::ClockReading>& readings) {
    ClockFacts facts;
    measure::addClocks(readings, facts.conditions);
    const std::vector<measure::ClockReading> busy = measure::readingsAtWork(readings);
    facts.taken_for_idle = busy.empty() && !readings.empty();
    for (const measure::ClockReading& reading : busy) {
        if (!reading.clock_mhz) continue;
        const double clock = *reading.clock_mhz;
        facts.lowest_mhz = std::min(facts.lowest_mhz.value_or(clock), clock);
        facts.highest_mhz = std::max(facts.highest_mhz.value_or(clock), clock);
    }
    facts.held = std::ranges::any_of(readings, &measure::ClockReading::held);
    return facts;
}

}  // namespace

Facts gatherFacts(
    const engine::Device& device, engine::Validation validation,
    const measure::MeasureHooks& hooks) {
    Facts facts;
    facts.load = loadNow();
    facts.device = report::describeDevice(device);
    facts.build = buildFacts();
    facts.layers = {.validation = validation != engine::Validation::off, .loaded = loadedLayers()};
    facts.timestamps = timestampFacts(device);
    facts.processor = {
        .governors = scalingGovernors(),
        .count = std::thread::hardware_concurrency(),
        .quota = processorQuota()};
    facts.on_battery = onBattery();
    if (facts.timestamps.valid_bits > 0) facts.passes = examinePasses(device, hooks);

    std::optional<measure::ClockSampler> sampler;
    if (auto source = measure::openClockSource(device.info())) sampler.emplace(std::move(source));
    if (sampler) sampler->begin();
    facts.repeat = examineRepeat(device, hooks);
    if (sampler) facts.clocks = clockFacts(sampler->take());
    return facts;
}

}  // namespace benchmarks::doctor
