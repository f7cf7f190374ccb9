#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "benchmarks/measure/clocks.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "engine/system/machine.h"
#include "hair/settings.h"

// Conditions of a measurement: clocks, throttling, steal time, load by other processes.

namespace benchmarks::measure {

// Adds the identity and power limit of the board to the record of its device. Leaves them out for a
// software device, and whatever is unknown.
void addBoard(const engine::DeviceInfo& device, report::DeviceRecord& record);

// 16 hexadecimal digits for the board with this UUID; empty for a UUID of zeros, which some drivers
// give.
std::string boardHash(std::span<const std::uint8_t> uuid);

// Samples a clock source while frames are played, because before and after that the device and its
// clocks are idle. A reading takes a few tens of microseconds of one processor, in a thread that
// otherwise sleeps.
class ClockSampler {
public:
    explicit ClockSampler(std::unique_ptr<ClockSource> source);
    ~ClockSampler();
    ClockSampler(const ClockSampler&) = delete;
    ClockSampler& operator=(const ClockSampler&) = delete;

    // Starts sampling, or restarts it. The first reading is one period later, when the device has
    // work.
    void begin();
    // Returns the readings from the time since begin() or the last take(). Makes no reading itself.
    std::vector<ClockReading> take();
    // The source's energy(). Does not wait for a reading.
    std::optional<double> energy() { return source_->energy(); }

private:
    void sampleUntilStopped();

    std::unique_ptr<ClockSource> source_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool running_ = false;
    bool restarted_ = false;
    bool stopped_ = false;
    std::vector<ClockReading> readings_;
    std::chrono::steady_clock::time_point begun_;
    std::chrono::steady_clock::time_point since_;  // start of the time that readings may cover
    std::thread thread_;
};

// A device with less load than this counts as idle.
inline constexpr double kIdleLoad = 0.2;

// Forgets the load of a reading, `passed` seconds after the device got work, if it may be that of
// the idle device before.
void forgetLateLoad(ClockReading& reading, double passed);

// Returns the readings taken while the device was at work. If the driver reports idle in all of
// them, it returns those with a load.
std::vector<ClockReading> readingsAtWork(const std::vector<ClockReading>& readings);

// Sets the medians over the readings taken at work, their lowest and low clocks, and all their
// throttle reasons without repetition.
void addClocks(const std::vector<ClockReading>& readings, report::Conditions& conditions);

// Medians of all rounds' numbers, and all throttle reasons.
report::Conditions medianConditions(const std::vector<report::Conditions>& rounds);

// Opens the source for this device's clocks: NVML (NVIDIA) or sysfs (amdgpu). Returns null on a
// software device and if there is no source.
std::unique_ptr<ClockSource> openClockSource(const engine::DeviceInfo& device);

// Holds the clocks as /run/clocks requires, until destruction. Throws engine::Unsupported with a
// remedy if that is impossible: on a software device, without a clock source, if the user may not
// lock clocks, and for free clocks if an administrator holds them.
class ClockHold {
public:
    ClockHold(const engine::DeviceInfo& device, hair::Clocks clocks);
    // `source` null: the device's clocks are unknown.
    ClockHold(
        const engine::DeviceInfo& device, hair::Clocks clocks, std::unique_ptr<ClockSource> source);

private:
    std::unique_ptr<ClockSource> source_;  // unlocks on destruction
};

// Watches the machine while rounds are played: the device's clocks if they are known, steal time,
// and the processor use of other processes (/proc/stat). On a software device the processors make
// the frames; with other devices they record them. Changes no setting.
class MachineWatch {
public:
    explicit MachineWatch(const engine::Device& device);
    ~MachineWatch();
    MachineWatch(const MachineWatch&) = delete;
    MachineWatch& operator=(const MachineWatch&) = delete;

    void begin();
    // Conditions since begin() or the last take().
    report::Conditions take();

private:
    struct Sources;
    std::unique_ptr<Sources> sources_;
};

// Mean power of the device.
struct MeanPower {
    double watts = 0.0;
    bool counted = false;  // by an energy counter
};

// The power over all rounds together, by the energy counter if it moved. Otherwise the median of
// the rounds' power readings, which contain what was before a round: NVML's are the means of a
// second. Absent if both are unknown.
std::optional<MeanPower> meanPower(const std::vector<report::Conditions>& rounds);

using engine::system::EnergyCounter;
using engine::system::ProcessorTicks;
using engine::system::readEnergyCounters;
using engine::system::readProcessorTicks;

// Energy in J; absent if a counter is unknown. A counter may have wrapped once.
std::optional<double>
joulesBetween(const std::vector<EnergyCounter>& before, const std::vector<EnergyCounter>& after);

// Shares of all processors' time.
struct ProcessorLoad {
    double steal = 0.0;
    double others = 0.0;  // used by other processes; clamped at 0 because ticks are coarse
};

// Load between two readings. This process used `own` ms of processor time between them. Absent if
// no tick passed.
std::optional<ProcessorLoad>
loadBetween(const ProcessorTicks& before, const ProcessorTicks& after, double own);

// Waits a little for other programs to end before a case is measured.

inline constexpr double kQuietLook = 0.2;  // s, 20 ticks of a processor's time or more
// Compilers and tests beside a measurement pause for seconds between their steps, so a longer wait
// seldom helps; and a machine that is always busy must not make a run much longer.
inline constexpr double kMostQuietWait = 5.0;  // s, for a case
inline constexpr double kMostQuietWaits = 10.0;  // s, for a run

class QuietWait {
public:
    // Returns the share of all processors' time that other programs use in the next `seconds`,
    // which it sleeps; absent if that is unknown.
    using Look = std::function<std::optional<double>(double seconds)>;

    // `tell` is called once a run, with the share, when a wait begins.
    QuietWait(Look look, std::function<void(double share)> tell);

    // Returns when others use at most report::kLittleLoad, or after the longest wait. That is never
    // longer than `max_time`, s, which the case may measure. Looks no more once the run's time for
    // waits is used up.
    void wait(double max_time);

private:
    Look look_;
    std::function<void(double share)> tell_;
    double left_ = kMostQuietWaits;
    bool told_ = false;
};

// Looks at /proc/stat. Throws Interrupted if the user asks to stop.
std::optional<double> otherLoad(double seconds);

}  // namespace benchmarks::measure
