#include "benchmarks/measure/machine_watch.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <utility>

#include "benchmarks/report/environment.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/verdict.h"
#include "engine/process.h"

namespace benchmarks::measure {
namespace {

// ---- Medians of readings and rounds -------------------------------------------------------------

// One member of the items that have it.
template <class Thing>
std::vector<double>
valuesOf(const std::vector<Thing>& things, std::optional<double> Thing::* member) {
    std::vector<double> known;
    for (const Thing& thing : things)
        if (thing.*member) known.push_back(*(thing.*member));
    return known;
}

// The functions below return nothing if no item has the member.

template <class Thing>
std::optional<double>
medianOf(const std::vector<Thing>& things, std::optional<double> Thing::* member) {
    const std::vector<double> known = valuesOf(things, member);
    if (known.empty()) return std::nullopt;
    return report::summarize(known).median;
}

template <class Thing>
std::optional<double>
lowestOf(const std::vector<Thing>& things, std::optional<double> Thing::* member) {
    const std::vector<double> known = valuesOf(things, member);
    if (known.empty()) return std::nullopt;
    return std::ranges::min(known);
}

// The value below which a quarter of the items are, and at least one of several. A driver may give
// a wrong reading, or a device may pause for a moment; a throttled one stays slow.
template <class Thing>
std::optional<double>
lowOf(const std::vector<Thing>& things, std::optional<double> Thing::* member) {
    std::vector<double> known = valuesOf(things, member);
    if (known.empty()) return std::nullopt;
    std::ranges::sort(known);
    return known[std::min(std::max<std::size_t>(known.size() / 4, 1), known.size() - 1)];
}

// All throttle reasons without repetition, in order of appearance.
template <class Thing>
std::vector<std::string> everyReason(const std::vector<Thing>& things) {
    std::vector<std::string> reasons;
    for (const Thing& thing : things)
        for (const std::string& reason : thing.throttle_reasons)
            if (std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(reason);
    return reasons;
}

// ---- Sampling of clocks -------------------------------------------------------------------------

// A round lasts tenths of a second; drivers update their values about this often.
constexpr std::chrono::milliseconds kPeriod{50};

}  // namespace

ClockSampler::ClockSampler(std::unique_ptr<ClockSource> source)
    : source_(std::move(source)), thread_([this] { sampleUntilStopped(); }) {}

ClockSampler::~ClockSampler() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void ClockSampler::begin() {
    {
        const std::lock_guard lock(mutex_);
        readings_.clear();
        running_ = true;
        restarted_ = true;
        since_ = begun_ = std::chrono::steady_clock::now();
    }
    changed_.notify_one();
}

std::vector<ClockReading> ClockSampler::take() {
    const std::lock_guard lock(mutex_);
    since_ = std::chrono::steady_clock::now();
    return std::exchange(readings_, {});
}

void ClockSampler::sampleUntilStopped() {
    std::unique_lock lock(mutex_);
    while (!stopped_) {
        changed_.wait(lock, [this] { return running_ || stopped_; });
        restarted_ = false;
        const bool still = !changed_.wait_for(
            lock, kPeriod, [this] { return !running_ || restarted_ || stopped_; });
        if (!still) continue;
        lock.unlock();
        const auto asked = std::chrono::steady_clock::now();
        ClockReading reading = source_->read();
        lock.lock();
        const std::chrono::duration<double> age(reading.age.value_or(0.0));
        if (!running_ || restarted_ || asked - age < since_) continue;
        forgetLateLoad(reading, std::chrono::duration<double>(asked - begun_).count());
        readings_.push_back(std::move(reading));
    }
}

void forgetLateLoad(ClockReading& reading, double passed) {
    if (passed < reading.load_lag && reading.load.value_or(1.0) < kIdleLoad) reading.load.reset();
}

std::vector<ClockReading> readingsAtWork(const std::vector<ClockReading>& readings) {
    std::vector<ClockReading> found;
    std::ranges::copy_if(readings, std::back_inserter(found), [](const ClockReading& each) {
        return !each.idle && each.load.value_or(1.0) >= kIdleLoad;
    });
    if (found.empty())
        std::ranges::copy_if(readings, std::back_inserter(found), [](const ClockReading& each) {
            return each.load.value_or(0.0) >= kIdleLoad;
        });
    return found;
}

void addClocks(const std::vector<ClockReading>& readings, report::Conditions& conditions) {
    const std::vector<ClockReading> busy = readingsAtWork(readings);
    conditions.lowest_clock_mhz = lowestOf(busy, &ClockReading::clock_mhz);
    conditions.low_clock_mhz = lowOf(busy, &ClockReading::clock_mhz);
    conditions.clock_mhz = medianOf(busy, &ClockReading::clock_mhz);
    conditions.base_clock_mhz = medianOf(busy, &ClockReading::base_clock_mhz);
    conditions.memory_clock_mhz = medianOf(busy, &ClockReading::memory_clock_mhz);
    conditions.temperature = medianOf(busy, &ClockReading::temperature);
    conditions.power_w = medianOf(busy, &ClockReading::power_w);
    conditions.load = medianOf(busy, &ClockReading::load);
    conditions.throttle_reasons = everyReason(busy);
}

// ---- Load of the processors ---------------------------------------------------------------------

std::optional<ProcessorLoad>
loadBetween(const ProcessorTicks& before, const ProcessorTicks& after, double own) {
    // The idle time is known to step back by a tick sometimes.
    if (after.total <= before.total) return std::nullopt;
    const auto between = [](std::uint64_t from, std::uint64_t to) {
        return to > from ? static_cast<double>(to - from) : 0.0;
    };
    const double total = between(before.total, after.total);
    const double own_ticks = own * 1e-3 * engine::system::ticksPerSecond();
    const double others = between(before.busy, after.busy) - own_ticks;
    return ProcessorLoad{
        .steal = std::min(between(before.steal, after.steal) / total, 1.0),
        .others = std::clamp(others / total, 0.0, 1.0)};
}

// ---- Conditions of a round ----------------------------------------------------------------------

report::Conditions medianConditions(const std::vector<report::Conditions>& rounds) {
    return {
        .clock_mhz = medianOf(rounds, &report::Conditions::clock_mhz),
        .lowest_clock_mhz = lowestOf(rounds, &report::Conditions::lowest_clock_mhz),
        .low_clock_mhz = lowestOf(rounds, &report::Conditions::low_clock_mhz),
        .base_clock_mhz = medianOf(rounds, &report::Conditions::base_clock_mhz),
        .memory_clock_mhz = medianOf(rounds, &report::Conditions::memory_clock_mhz),
        .temperature = medianOf(rounds, &report::Conditions::temperature),
        .power_w = medianOf(rounds, &report::Conditions::power_w),
        .load = medianOf(rounds, &report::Conditions::load),
        .steal = medianOf(rounds, &report::Conditions::steal),
        .other_load = medianOf(rounds, &report::Conditions::other_load),
        .throttle_reasons = everyReason(rounds)};
}

std::optional<MeanPower> meanPower(const std::vector<report::Conditions>& rounds) {
    double joules = 0.0, seconds = 0.0;
    for (const report::Conditions& round : rounds) {
        if (!round.energy_j || !round.energy_s) continue;
        joules += *round.energy_j;
        seconds += *round.energy_s;
    }
    if (joules > 0.0 && seconds > 0.0) return MeanPower{joules / seconds, true};
    const auto watts = medianOf(rounds, &report::Conditions::power_w);
    if (!watts) return std::nullopt;
    return MeanPower{*watts, false};
}

std::unique_ptr<ClockSource> openClockSource(const engine::DeviceInfo& device) {
    const std::optional<PciAddress> address = pciAddress(device);
    if (!address) return nullptr;
    if (auto nvml = openNvml(*address)) return nvml;
    if (auto amdgpu = openAmdgpu(*address)) return amdgpu;
    return openIntel(*address);
}

std::string boardHash(std::span<const std::uint8_t> uuid) {
    if (std::ranges::all_of(uuid, [](std::uint8_t each) { return each == 0; })) return {};
    return report::hashBytes(std::as_bytes(uuid));
}

void addBoard(const engine::DeviceInfo& device, report::DeviceRecord& record) {
    if (device.type == engine::DeviceType::cpu) return;
    VkPhysicalDeviceIDProperties identity{};
    identity.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &identity;
    vkGetPhysicalDeviceProperties2(device.handle, &properties);
    record.board = boardHash(identity.deviceUUID);
    if (const auto address = pciAddress(device)) record.pci_address = addressText(*address);
    if (const auto source = openClockSource(device)) record.power_limit_w = source->powerLimit();
}

ClockHold::ClockHold(const engine::DeviceInfo& device, hair::Clocks clocks)
    : ClockHold(
          device, clocks, clocks == hair::Clocks::as_found ? nullptr : openClockSource(device)) {}

ClockHold::ClockHold(
    const engine::DeviceInfo& device, hair::Clocks clocks, std::unique_ptr<ClockSource> source)
    : source_(std::move(source)) {
    if (clocks == hair::Clocks::as_found) return;
    const std::string context =
        std::string("/run/clocks ") + (clocks == hair::Clocks::locked ? "locked" : "free");
    if (device.type == engine::DeviceType::cpu)
        throw engine::Unsupported(
            context, "a software device has the processors' clocks, which an administrator sets: "
                     "cpupower frequency-set --governor performance");
    if (!source_)
        throw engine::Unsupported(context, "the clocks of " + device.name + " are not known");
    if (clocks == hair::Clocks::locked && !source_->lock())
        throw engine::Unsupported(
            context, "the driver does not let this user lock clocks; as administrator, run " +
                         source_->lockCommand() + " and then measure without /run/clocks");
    if (clocks == hair::Clocks::free && source_->read().held)
        throw engine::Unsupported(
            context, "an administrator has locked the clocks of " + device.name);
}

struct MachineWatch::Sources {
    std::optional<ClockSampler> clocks;
    std::optional<ProcessorTicks> ticks;  // at begin()
    double own = 0.0;  // CPU time of this process at begin(), ms
    bool is_processor = false;
    std::vector<EnergyCounter> packages;  // at begin(); used if the device is a processor
    std::optional<double> energy;  // J, at begin(), of other devices
    std::chrono::steady_clock::time_point energy_time;

    // Energy since the last call, J; absent before the second.
    std::optional<double> energySince() {
        if (is_processor) {
            std::vector<EnergyCounter> now = readEnergyCounters();
            const auto joules = joulesBetween(packages, now);
            packages = std::move(now);
            return joules;
        }
        const std::optional<double> before = energy;
        energy = clocks ? clocks->energy() : std::nullopt;
        // A driver that was loaded again counts from 0.
        if (!before || !energy || *energy < *before) return std::nullopt;
        return *energy - *before;
    }
};

MachineWatch::MachineWatch(const engine::Device& device) : sources_(std::make_unique<Sources>()) {
    sources_->is_processor = device.info().type == engine::DeviceType::cpu;
    if (auto source = openClockSource(device.info())) sources_->clocks.emplace(std::move(source));
}

MachineWatch::~MachineWatch() = default;

void MachineWatch::begin() {
    sources_->ticks = readProcessorTicks();
    sources_->own = engine::processUse().cpu;
    sources_->energySince();
    sources_->energy_time = std::chrono::steady_clock::now();
    if (sources_->clocks) sources_->clocks->begin();
}

std::optional<double>
joulesBetween(const std::vector<EnergyCounter>& before, const std::vector<EnergyCounter>& after) {
    if (after.empty() || before.size() != after.size()) return std::nullopt;
    double sum = 0.0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::uint64_t used =
            after[i].microjoules >= before[i].microjoules
                ? after[i].microjoules - before[i].microjoules
                : after[i].microjoules + after[i].range + 1 - before[i].microjoules;
        sum += static_cast<double>(used) * 1e-6;
    }
    return sum;
}

report::Conditions MachineWatch::take() {
    report::Conditions conditions;
    if (sources_->clocks) addClocks(sources_->clocks->take(), conditions);
    const auto time = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = time - sources_->energy_time;
    sources_->energy_time = time;
    const std::optional<double> joules = sources_->energySince();
    if (joules && passed.count() > 0.0) {
        conditions.energy_j = joules;
        conditions.energy_s = passed.count();
        if (!conditions.power_w) conditions.power_w = *joules / passed.count();
    }
    const std::optional<ProcessorTicks> now = readProcessorTicks();
    const double used = engine::processUse().cpu;
    if (now && sources_->ticks) {
        if (const auto load = loadBetween(*sources_->ticks, *now, used - sources_->own)) {
            conditions.steal = load->steal;
            conditions.other_load = load->others;
        }
    }
    sources_->ticks = now;
    sources_->own = used;
    return conditions;
}

// ---- A wait for quiet ---------------------------------------------------------------------------

QuietWait::QuietWait(Look look, std::function<void(double share)> tell)
    : look_(std::move(look)), tell_(std::move(tell)) {}

void QuietWait::wait(double max_time) {
    const double most = std::min({left_, kMostQuietWait, max_time});
    double waited = 0.0;
    // The first look is no wait.
    while (waited + kQuietLook <= most) {
        const std::optional<double> share = look_(kQuietLook);
        if (!share || *share <= report::kLittleLoad) return;
        if (!std::exchange(told_, true)) tell_(*share);
        waited += kQuietLook;
        left_ -= kQuietLook;
    }
}

std::optional<double> otherLoad(double seconds) {
    const auto before = readProcessorTicks();
    if (!before) return std::nullopt;
    const double used = engine::processUse().cpu;
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    engine::checkInterrupted();
    const auto after = readProcessorTicks();
    if (!after) return std::nullopt;
    const auto load = loadBetween(*before, *after, engine::processUse().cpu - used);
    if (!load) return std::nullopt;
    return load->others;
}

}  // namespace benchmarks::measure
