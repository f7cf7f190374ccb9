#include "benchmarks/doctor/facts.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include <link.h>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/report/environment.h"
#include "engine/commands.h"
#include "engine/process.h"
#include "engine/queries.h"
#include "engine/transfer.h"

namespace benchmarks::doctor {
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

int collect(dl_phdr_info* library, std::size_t, void* data) {
    if (isLayerLibrary(library->dlpi_name)) {
        static_cast<std::vector<std::string>*>(data)->emplace_back(fileName(library->dlpi_name));
    }
    return 0;
}

}  // namespace

bool isLayerLibrary(std::string_view path) {
    const std::string_view name = fileName(path);
    return std::ranges::any_of(
        kMarks, [&](std::string_view mark) { return name.find(mark) != std::string_view::npos; });
}

std::vector<std::string> loadedLayers() {
    std::vector<std::string> layers;
    dl_iterate_phdr(collect, &layers);
    return layers;
}

namespace {

// ---- How Linux runs the processors --------------------------------------------------------------

// Returns the first word; empty if there is no such file.
std::string wordIn(const fs::path& path) {
    std::string word;
    std::ifstream(path) >> word;
    return word;
}

// Returns the entries of a folder; empty if the folder is missing.
std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(folder, missing))
        entries.push_back(entry.path());
    return entries;
}

std::optional<double> ratio(double quota, double period) {
    if (quota <= 0.0 || period <= 0.0) return std::nullopt;
    return quota / period;
}

}  // namespace

std::vector<std::string> scalingGovernors(const fs::path& root) {
    std::set<std::string> governors;
    for (const fs::path& processor : entriesOf(root / "sys/devices/system/cpu")) {
        const std::string governor = wordIn(processor / "cpufreq/scaling_governor");
        if (!governor.empty()) governors.insert(governor);
    }
    return {governors.begin(), governors.end()};
}

std::optional<double> processorQuota(const fs::path& root) {
    // Version 2: "max 100000" or "150000 100000", both in microseconds.
    const fs::path groups = root / "sys/fs/cgroup";
    double quota = 0.0, period = 0.0;
    if (std::ifstream file(groups / "cpu.max"); file >> quota >> period)
        return ratio(quota, period);
    // Version 1: a quota of -1 means no quota.
    std::ifstream(groups / "cpu/cpu.cfs_quota_us") >> quota;
    std::ifstream(groups / "cpu/cpu.cfs_period_us") >> period;
    return ratio(quota, period);
}

std::optional<bool> onBattery(const fs::path& root) {
    std::optional<bool> battery;
    for (const fs::path& supply : entriesOf(root / "sys/class/power_supply")) {
        const std::string type = wordIn(supply / "type");
        if (type == "Mains" || type.starts_with("USB")) {
            if (wordIn(supply / "online") == "1") return false;
        } else if (type == "Battery" && wordIn(supply / "scope") != "Device") {
            // A scope of Device is the battery of a mouse or keyboard.
            battery = battery.value_or(false) || wordIn(supply / "status") == "Discharging";
        }
    }
    return battery;
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
