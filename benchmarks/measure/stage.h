#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/frame_loop.h"
#include "engine/pipeline.h"

// Work that slows down one pass by a known amount, to test the detection of slowdowns.

namespace benchmarks::measure {

// Steps of work that nobody needs. No driver can leave them out, because the results are written to
// a buffer. The work is proportional to the number of steps.
class BusyWork {
public:
    BusyWork(const engine::Device& device, std::uint32_t steps);

    // Records the steps after all earlier commands and before all later ones, as if the earlier
    // ones had taken longer. Does nothing for 0 steps.
    void record(engine::Commands& commands) const;

    // Number of work groups that share the steps: enough to fill a GPU. It is small on a processor,
    // where starting a group costs more than a step.
    std::uint32_t groups() const { return groups_; }

    // Results since construction. Waits for the device.
    struct Done {
        std::uint32_t steps;  // modulo 2^32
        std::vector<std::uint32_t>
            numbers;  // [group], exclusive or of all numbers of its invocations
    };
    Done done() const;

private:
    const engine::Device& device_;
    std::uint32_t steps_;
    std::uint32_t groups_;
    engine::ComputePipeline pipeline_;
    engine::Buffer results_;
};

// The pass that is slowed down, and the names of the passes that ran.
class BusyPass {
public:
    BusyPass(const engine::Device& device, std::string name, std::uint32_t steps);

    // Throws engine::Error with the list of passes if none so far had the name.
    void checkThatItRan() const;

    const BusyWork& work() const { return work_; }

private:
    friend class BusyPasses;
    std::string name_;
    BusyWork work_;
    std::vector<std::string> seen_;  // names, in order of appearance
};

// Forwards a frame's passes and appends the work to the busy one. The work is inside the pass, so
// the pass's timer, label and metric include it.
class BusyPasses : public engine::Passes {
public:
    BusyPasses(engine::Passes& passes, BusyPass& busy);

    void pass(
        const char* name, engine::PassKind kind,
        engine::FunctionRef<void(engine::Commands&)> record) override;
    void asyncCompute(std::uint32_t frames, engine::FunctionRef<void()> record) override {
        passes_.asyncCompute(frames, record);
    }

private:
    engine::Passes& passes_;
    BusyPass& busy_;
};

// The stage on which frames are played and timed: a device and the machine's clock, or a model of
// both.

// Progress of a mode of a case, to show while it is measured.
struct SamplingState {
    std::string mode;
    std::uint32_t rounds = 0;
    double median = 0.0;  // ms, of the frames so far
    std::optional<double> relative_half_width;  // of its 95 % interval; absent: too few samples
    double seconds = 0.0;  // since the mode began
    double max_seconds = 0.0;  // s at which its last round begins at the latest
};

// Facts about its device that a run has learnt in earlier cases.
struct DeviceKnowledge {
    // The highest clocks under full load, by /run/clocks.
    std::map<hair::Clocks, report::HighestClocks> held_clocks;
    // Names of the passes of frames whose timestamps were checked and are right.
    std::vector<std::vector<std::string>> trusted_passes;
    // For frames with these passes: the number of passes in which planted work was found so far.
    std::map<std::vector<std::string>, std::size_t> checked_passes;
    std::uint32_t planted_steps = 0;  // length of the planted work; 0: not known yet
    // The result of Stage::timestampRate(), once it is known.
    std::optional<std::optional<double>> timestamp_rate;
};

struct MeasureHooks {
    std::function<bool()> stop;  // called between frames; true ends the measurement with
                                 // Interrupted
    std::function<void(const SamplingState&)> progress{};  // called after each round; may be empty
    DeviceKnowledge* known = nullptr;  // of the run; null: each case learns for itself
};

// The result at the end of a play of frames.
struct RoundEnd {
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first
    std::string picture_hash;
    std::string state_hash;
};

// Plays frames in one timing mode, one after another.
class Player {
public:
    virtual ~Player() = default;

    // Makes the next frame the first one again, after all frames so far and without waiting for
    // them.
    virtual void reset() = 0;
    // Plays the next frame. Throws Interrupted if the user asks to stop.
    virtual void frame() = 0;
    // Plays the next frame untimed and without planted work, and counts its work in the stage. All
    // frames must be finished.
    virtual void count() = 0;
    // As in engine::FrameLoop: the complete frames without waiting, and all remaining frames.
    virtual std::vector<engine::FrameRecord> completed() = 0;
    virtual std::vector<engine::FrameRecord> finish() = 0;
    // Picture and state of the last frame. All frames must be finished.
    virtual RoundEnd end() = 0;
};

// Steps of BusyWork in the named pass.
struct PlantedWork {
    std::string pass;
    std::uint32_t steps = 0;
};

// Duration for which Stage::timestampRate() watches both clocks, s.
inline constexpr double kRateTime = 0.1;

// The stage of a case's frames for measure().
class Stage {
public:
    virtual ~Stage() = default;

    // Plays the case's frames with the scene's own planted work.
    virtual std::unique_ptr<Player> player(engine::Timing timing) = 0;
    // Plays the case's frames with only this work.
    virtual std::unique_ptr<Player> player(engine::Timing timing, const PlantedWork& planted) = 0;
    // Plays frames with only a pass of `steps` steps of BusyWork; with 0 steps there is no
    // pass.
    virtual std::unique_ptr<Player> emptyPlayer(engine::Timing timing, std::uint32_t steps) = 0;

    // True if the processors that record frames also make them. Then no clock has to be raised, and
    // frames are so long that the time between frames is irrelevant.
    virtual bool isProcessor() const = 0;

    // True if time passes while samples are assessed; false for a model.
    virtual bool overlapsAssessment() const { return true; }

    // The machine's clock, s.
    virtual double seconds() = 0;
    virtual void pause(double seconds) = 0;

    // Ratio of the device's timestamp rate to its nominal rate, by a clock that device and host can
    // both read. Absent without such a clock. Takes kRateTime.
    virtual std::optional<double> timestampRate() = 0;

    // Time in ms, by timestamps, of an empty pass: two barriers and two timestamps. Absent without
    // timestamps.
    virtual std::optional<double> emptyPass() = 0;

    // Starts watching the machine.
    virtual void beginWatch() = 0;
    // Conditions since beginWatch() or the last conditions(). Does not query the device.
    virtual report::Conditions conditions() = 0;
};

// Plays frames without a pass and measures their submission. On a GPU with timestamps they contain
// work as long as a frame of the case, `frame` ms, or 2 ms if that is shorter: a thread wakes up
// later after a millisecond's wait than after some microseconds.
EmptySubmission measureEmptySubmission(Stage& stage, double frame);

// A case on a device. All arguments must outlive it, and it must outlive its players.
class DeviceStage : public Stage {
public:
    // Throws engine::Unsupported for /run/async_compute on a device with one queue.
    DeviceStage(
        const engine::Device& device, Case& test_case, const hair::RunSettings& run,
        const MeasureHooks& hooks);

    // Throw engine::Error, at the end of the first frames, if no pass has the name of the planted
    // work.
    std::unique_ptr<Player> player(engine::Timing timing) override;
    std::unique_ptr<Player> player(engine::Timing timing, const PlantedWork& planted) override;
    std::unique_ptr<Player> emptyPlayer(engine::Timing timing, std::uint32_t steps) override;
    bool isProcessor() const override { return device_.info().type == engine::DeviceType::cpu; }
    double seconds() override;
    void pause(double seconds) override;
    std::optional<double> timestampRate() override;
    std::optional<double> emptyPass() override;
    void beginWatch() override { watch_.begin(); }
    report::Conditions conditions() override { return watch_.take(); }

    // Statistics, transparency and warnings of the last counted frame.
    report::CaseResult takeCounted() { return std::move(counted_); }

private:
    const engine::Device& device_;
    Case& test_case_;
    const hair::RunSettings& run_;
    const MeasureHooks& hooks_;
    MachineWatch watch_;
    report::CaseResult counted_;
};

}  // namespace benchmarks::measure
