#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/stage.h"
#include "engine/queries.h"

// A model of a GPU, its driver and its host, so that measurements can be compared with the true
// values. It has its own clock, so that an hour of measuring takes seconds.
namespace benchmarks::measure {

struct GpuModel {
    struct Pass {
        std::string name;
        double cycles;
    };
    std::vector<Pass> passes{{"wind", 20e3}, {"simulate", 80e3}, {"strands", 300e3}};
    // Cost of a play's frame relative to the first, frames counted from 0.
    std::function<double(std::uint32_t frame)> profile = [](std::uint32_t) { return 1.0; };
    double overlap = 0.0;  // share of the passes' time that overlap saves
    double empty_pass = 0.0;  // s, that barriers and timestamps add to an isolated pass

    double slow = 210e6, fast = 1980e6;  // Hz
    double rise = 0.3;  // s of load from slow to fast
    double decay = 0.05;  // s of idling back to slow
    double idle_after = 2e-3;  // s; the governor ignores shorter gaps

    std::size_t frames_in_flight = 2;
    double record = 5e-6, submit = 2e-6;  // s of CPU time for a frame
    double least_latency = 20e-6, most_latency = 60e-6;  // s, of submitting and of waking up
    double tail = 0.01;  // share of latencies that are ten times as long
    double sleeps_after = 1e9;  // s of waiting after which waking up takes `sleep` longer
    double sleep = 0.0;  // s
    double stalls = 0.0;  // per second: the compositor takes the device
    double stall = 2e-3;  // s

    double throttled_share = 0.0;  // of the time, in stretches of 0.5 to 1.5 s
    double throttled_clock = 0.7;  // relative to `fast`
    std::string throttle_reason;  // reason reported by the driver; empty: none

    double watts = 300.0, idle_watts = 60.0, throttled_watts = 150.0;
    bool counts_energy = false;

    double period = 1.0;  // ns, of a timestamp's tick
    std::uint32_t valid_bits = 64;
    double stamp_rate = 1.0;
    bool timestamps_shifted = false;  // a pass's time is that of the previous pass
    bool calibrated = true;  // host and device can read a common clock
    bool processor = false;  // the device reports that it is a processor
    bool waits_for_all = false;  // a wait for a frame ends only when all submitted frames are done

    double most_age = 0.1;  // s, of a clock reading
    std::optional<double> power{};  // W, as read; absent: the mean of about a second
    bool tells_age = false;
    double cycles_per_step = 1.0;  // of planted work
};

class SimulatedGpu : public Stage {
public:
    SimulatedGpu(GpuModel model, std::uint32_t seed)
        : model_(std::move(model)), random_(seed), clock_(model_.slow) {
        next_stall_ = model_.stalls > 0.0 ? exponential(1.0 / model_.stalls) : kNever;
        throttle_from_ = model_.throttled_share > 0.0 ? 0.0 : kNever;
        if (model_.throttled_share > 0.0) nextThrottle();
    }

    // True time of a pass at the full clock, ms.
    double truth(const std::string& pass) const {
        for (const GpuModel::Pass& each : model_.passes)
            if (each.name == pass) return each.cycles / model_.fast * 1e3;
        return 0.0;
    }
    double truth() const {
        double sum = 0.0;
        for (const GpuModel::Pass& each : model_.passes) sum += truth(each.name);
        return sum * (1.0 - model_.overlap);
    }

    std::unique_ptr<Player> player(engine::Timing timing) override {
        return std::make_unique<Frames>(*this, timing, PlantedWork{}, false);
    }
    std::unique_ptr<Player> player(engine::Timing timing, const PlantedWork& planted) override {
        return std::make_unique<Frames>(*this, timing, planted, false);
    }
    std::unique_ptr<Player> emptyPlayer(engine::Timing timing, std::uint32_t steps) override {
        return std::make_unique<Frames>(*this, timing, PlantedWork{"", steps}, true);
    }
    bool isProcessor() const override { return model_.processor; }
    bool overlapsAssessment() const override { return false; }
    double seconds() override { return now_; }
    void pause(double seconds) override { now_ += seconds; }
    std::optional<double> timestampRate() override {
        if (!model_.calibrated) return std::nullopt;
        return model_.stamp_rate;
    }

    std::optional<double> emptyPass() override {
        return model_.valid_bits == 0 ? std::nullopt : std::optional(model_.empty_pass * 1e3);
    }

    void beginWatch() override {
        since_ = now_;
        counted_ = energy_;
        next_reading_ = now_ + kReadingPeriod;
        if (history_.empty()) note();
    }

    report::Conditions conditions() override {
        std::vector<ClockReading> readings;
        for (; next_reading_ <= now_; next_reading_ += kReadingPeriod) {
            const double age = uniform(0.0, model_.most_age);
            if (model_.tells_age && next_reading_ - age < since_) continue;
            const State* seen = &history_.front();
            for (const State& each : history_)
                if (each.time <= next_reading_ - age) seen = &each;
            // Clocks come in steps of 15 MHz.
            ClockReading reading{
                .clock_mhz = 15.0 * std::round(seen->clock / 15e6),
                .power_w = model_.power.value_or(seen->power),
                .load = seen->load};
            if (model_.tells_age) reading.age = age;
            if (seen->throttled && !model_.throttle_reason.empty())
                reading.throttle_reasons = {model_.throttle_reason};
            readings.push_back(std::move(reading));
        }
        // Later readings may still refer to these states.
        while (history_.size() > 1 && history_[1].time < next_reading_ - 2.0 * model_.most_age)
            history_.pop_front();
        report::Conditions conditions;
        addClocks(readings, conditions);
        if (model_.counts_energy) {
            conditions.energy_j = energy_ - counted_;
            conditions.energy_s = now_ - since_;
        }
        counted_ = energy_;
        since_ = now_;
        return conditions;
    }

    // Seconds of throttling so far.
    double throttled() const { return throttled_; }

    // Number of frames with passes so far.
    std::uint32_t frames() const { return frames_; }

private:
    static constexpr double kNever = std::numeric_limits<double>::infinity();
    static constexpr double kReadingPeriod = 0.05;  // s
    static constexpr double kLoadWindow = 0.1;  // s
    static constexpr double kPowerWindow = 1.0;  // s
    static constexpr double kNotes = 1e-3;  // s between two recorded states

    struct State {
        double time;
        double clock;
        double load;
        double power;  // W
        bool throttled;
    };

    class Frames : public Player {
    public:
        Frames(SimulatedGpu& gpu, engine::Timing timing, PlantedWork planted, bool empty)
            : gpu_(gpu), timing_(timing), planted_(std::move(planted)), empty_(empty) {}

        void reset() override { frame_ = 0; }
        void count() override {
            frame();
            finish();
        }

        void frame() override {
            if (!empty_) ++gpu_.frames_;
            const double start = gpu_.now_;
            const bool overlapped = timing_ == engine::Timing::overlapped;
            if (overlapped && in_flight_.size() == gpu_.model_.frames_in_flight) collect();
            if (!records_.empty()) records_.back().interval = (start - start_) * 1e3;
            start_ = start;
            engine::FrameRecord record;
            record.wait = (gpu_.now_ - start) * 1e3;
            gpu_.now_ += gpu_.model_.record;
            if (timing_ == engine::Timing::wall_clock) {
                playPasses(record);
            } else {
                const double submission = gpu_.now_;
                gpu_.now_ += gpu_.model_.submit;
                const double done = play(record, gpu_.now_ + gpu_.latency());
                in_flight_.push_back(done);
                if (!overlapped) {
                    collect();
                    record.wall = (gpu_.now_ - submission) * 1e3;
                }
            }
            records_.push_back(std::move(record));
            ++frame_;
        }

        std::vector<engine::FrameRecord> completed() override {
            const std::size_t held_back = std::max<std::size_t>(in_flight_.size(), 1);
            if (records_.size() <= held_back) return {};
            const auto end =
                records_.begin() + static_cast<std::ptrdiff_t>(records_.size() - held_back);
            std::vector<engine::FrameRecord> complete(
                std::make_move_iterator(records_.begin()), std::make_move_iterator(end));
            records_.erase(records_.begin(), end);
            return complete;
        }

        std::vector<engine::FrameRecord> finish() override {
            while (!in_flight_.empty()) collect();
            if (!records_.empty()) records_.back().interval = (gpu_.now_ - start_) * 1e3;
            return std::exchange(records_, {});
        }

        // Every play ends with the same frame.
        RoundEnd end() override { return {{}, std::to_string(frame_), std::to_string(frame_)}; }

    private:
        // Waits for the oldest frame.
        void collect() {
            const double done = gpu_.model_.waits_for_all ? in_flight_.back() : in_flight_.front();
            if (done > gpu_.now_) {
                const bool slept = done - gpu_.now_ > gpu_.model_.sleeps_after;
                gpu_.now_ = done + gpu_.latency() + (slept ? gpu_.model_.sleep : 0.0);
            }
            in_flight_.pop_front();
        }

        double cyclesOf(const GpuModel::Pass& pass) const {
            const double planted =
                pass.name == planted_.pass ? planted_.steps * gpu_.model_.cycles_per_step : 0.0;
            return pass.cycles * gpu_.model_.profile(frame_) + planted;
        }

        std::uint64_t ticksAt(double time) const {
            const double ticks = time * 1e9 / gpu_.model_.period * gpu_.model_.stamp_rate;
            // Counters have run for a while when a program starts; this one is about to wrap.
            const std::uint64_t mask = engine::validMask(gpu_.model_.valid_bits);
            return (static_cast<std::uint64_t>(ticks) + mask - 1000000) & mask;
        }
        double between(double from, double to) const {  // ms by stamps
            return static_cast<double>(engine::ticksBetween(
                       ticksAt(from), ticksAt(to), engine::validMask(gpu_.model_.valid_bits))) *
                   gpu_.model_.period * 1e-6;
        }

        // Plays all passes in one submission that reaches the device at `arrival`. Returns its end.
        double play(engine::FrameRecord& record, double arrival) {
            double time = std::max(arrival, gpu_.busy_until_);
            const double first = time;
            if (empty_) {
                if (planted_.steps > 0)
                    time = gpu_.work(planted_.steps * gpu_.model_.cycles_per_step, time);
                if (planted_.steps > 0 && gpu_.model_.valid_bits > 0)
                    record.device = between(first, time);
                return time;
            }
            const double share =
                timing_ == engine::Timing::overlapped ? 1.0 - gpu_.model_.overlap : 1.0;
            std::vector<double> times;
            for (const GpuModel::Pass& pass : gpu_.model_.passes) {
                const double from = time;
                time = gpu_.work(cyclesOf(pass) * share, time);
                if (timing_ == engine::Timing::isolated) time += gpu_.model_.empty_pass;
                times.push_back(between(from, time));
            }
            if (gpu_.model_.valid_bits == 0) return time;
            record.device = between(first, time);
            if (last_) record.gap = between(*last_, first);
            last_ = time;
            if (gpu_.model_.timestamps_shifted) std::ranges::rotate(times, times.end() - 1);
            for (std::size_t i = 0; i < times.size(); ++i)
                record.passes.push_back({gpu_.model_.passes[i].name, times[i], {}});
            return time;
        }

        // Plays each pass in its own submission and waits for it.
        void playPasses(engine::FrameRecord& record) {
            for (const GpuModel::Pass& pass : gpu_.model_.passes) {
                const double submission = gpu_.now_;
                gpu_.now_ += gpu_.model_.submit;
                const double arrival = std::max(gpu_.now_ + gpu_.latency(), gpu_.busy_until_);
                gpu_.now_ = gpu_.work(cyclesOf(pass), arrival) + gpu_.latency();
                const double time = (gpu_.now_ - submission) * 1e3;
                record.passes.push_back({pass.name, time, {}});
                record.wall += time;
            }
        }

        SimulatedGpu& gpu_;
        engine::Timing timing_;
        PlantedWork planted_;
        bool empty_;
        std::uint32_t frame_ = 0;
        double start_ = 0.0;
        std::optional<double> last_;  // s, the end of the previous frame
        std::vector<engine::FrameRecord> records_;
        std::deque<double> in_flight_;  // their end times
    };

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    double exponential(double mean) {
        return std::exponential_distribution<double>(1.0 / mean)(random_);
    }
    double latency() {
        const double usual = uniform(model_.least_latency, model_.most_latency);
        return uniform(0.0, 1.0) < model_.tail ? 10.0 * usual : usual;
    }

    void nextThrottle() {
        const double length = uniform(0.5, 1.5);
        const double share = model_.throttled_share;
        throttle_from_ =
            std::max(throttle_to_, 0.0) + uniform(0.5, 1.5) * length * (1.0 - share) / share;
        throttle_to_ = throttle_from_ + length;
    }

    bool isThrottledAt(double time) {
        while (time >= throttle_to_ && throttle_from_ != kNever) nextThrottle();
        return time >= throttle_from_ && time < throttle_to_;
    }

    void note() {
        const double window = busy_until_ - noted_;
        // Drivers report the mean over a window.
        if (window > 0.0)
            load_ += (std::clamp(busy_ / window, 0.0, 1.0) - load_) *
                     (1.0 - std::exp(-window / kLoadWindow));
        if (window > 0.0)
            power_ += ((energy_ - noted_energy_) / window - power_) *
                      (1.0 - std::exp(-window / kPowerWindow));
        history_.push_back({busy_until_, clock_, load_, power_, isThrottledAt(busy_until_)});
        noted_ = busy_until_;
        noted_energy_ = energy_;
        busy_ = 0.0;
    }

    // Executes cycles from `time` on. Returns the end.
    double work(double cycles, double time) {
        const double idle = time - busy_until_;
        if (idle > model_.idle_after)
            clock_ =
                std::max(model_.slow, clock_ - (model_.fast - model_.slow) * idle / model_.decay);
        energy_ += idle * model_.idle_watts;
        const double begin = time;
        while (cycles > 0.0) {
            if (time >= next_stall_) {
                time += model_.stall;
                energy_ += model_.stall * model_.watts;
                next_stall_ = time + exponential(1.0 / model_.stalls);
            }
            const bool throttled = isThrottledAt(time);
            const double most = throttled ? model_.throttled_clock * model_.fast : model_.fast;
            clock_ = std::min(clock_, most);
            const double step = std::min(cycles / clock_, 0.5e-3);
            cycles -= std::max(step * clock_, 1e-6);
            clock_ = std::min(clock_ + (model_.fast - model_.slow) / model_.rise * step, most);
            time += step;
            energy_ += step * (throttled ? model_.throttled_watts : model_.watts);
            if (throttled) throttled_ += step;
        }
        busy_ += time - begin;
        busy_until_ = time;
        if (time - noted_ > kNotes) note();
        return time;
    }

    GpuModel model_;
    std::mt19937_64 random_;
    double now_ = 0.0;  // s, of the host
    double clock_;  // Hz
    double busy_until_ = 0.0;
    double busy_ = 0.0;  // busy time since the last recorded state, s
    double noted_ = 0.0;
    double load_ = 0.0;
    double energy_ = 0.0;  // J
    double counted_ = 0.0;  // J, when the last conditions ended
    double noted_energy_ = 0.0;
    double power_ = 0.0;  // W, the mean of about a second
    double next_stall_;
    double throttle_from_;
    double throttle_to_ = 0.0;
    double throttled_ = 0.0;
    std::uint32_t frames_ = 0;
    double since_ = 0.0;
    double next_reading_ = 0.0;
    std::deque<State> history_;
};

}  // namespace benchmarks::measure
