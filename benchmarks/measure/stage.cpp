#include "benchmarks/measure/stage.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <thread>

#include "benchmarks/measure/gpu_structs.h"
#include "benchmarks/report/environment.h"
#include "engine/error.h"
#include "engine/queries.h"
#include "engine/transfer.h"

namespace benchmarks::measure {

// ---- Busy work ----------------------------------------------------------------------------------

namespace {

// 262,144 invocations fill the largest GPUs. 64 work groups are shared evenly by any processor's
// threads.
constexpr std::uint32_t kGroups = 4096;
constexpr std::uint32_t kProcessorGroups = 64;

}  // namespace

BusyWork::BusyWork(const engine::Device& device, std::uint32_t steps)
    : device_(device), steps_(steps),
      groups_(device.info().type == engine::DeviceType::cpu ? kProcessorGroups : kGroups),
      pipeline_(device, {.shader = "busy/busy.comp", .push_size = sizeof(gpu::BusyPush)}),
      results_(engine::makeBuffer(
          device, std::vector<std::uint32_t>(1 + groups_, 0), "busy work", "measuring")) {}

void BusyWork::record(engine::Commands& commands) const {
    if (steps_ == 0) return;
    commands.orderAll();
    commands.bind(pipeline_, gpu::BusyPush{.results = commands.writes(results_), .steps = steps_});
    commands.dispatch(std::min(steps_, groups_));
    commands.orderAll();
}

BusyWork::Done BusyWork::done() const {
    const auto results = engine::downloadAs<std::uint32_t>(device_, results_);
    return {results.front(), {results.begin() + 1, results.end()}};
}

// ---- Busy passes --------------------------------------------------------------------------------

BusyPass::BusyPass(const engine::Device& device, std::string name, std::uint32_t steps)
    : name_(std::move(name)), work_(device, steps) {}

void BusyPass::checkThatItRan() const {
    if (std::ranges::find(seen_, name_) != seen_.end()) return;
    std::string known;
    for (const std::string& name : seen_) known += (known.empty() ? "" : ", ") + name;
    throw engine::Error("/run/busy_pass", "unknown pass '" + name_ + "'; known: " + known);
}

BusyPasses::BusyPasses(engine::Passes& passes, BusyPass& busy) : passes_(passes), busy_(busy) {
    slot_ = passes.slot();
}

void BusyPasses::pass(
    const char* name, engine::PassKind kind, engine::FunctionRef<void(engine::Commands&)> record) {
    if (std::ranges::find(busy_.seen_, name) == busy_.seen_.end()) busy_.seen_.emplace_back(name);
    if (busy_.name_ != name) {
        passes_.pass(name, kind, record);
        return;
    }
    passes_.pass(name, kind, [&](engine::Commands& commands) {
        record(commands);
        busy_.work().record(commands);
    });
}

// ---- The device as a stage ----------------------------------------------------------------------

namespace {

using Seconds = std::chrono::duration<double>;

class DevicePlayer : public Player {
public:
    DevicePlayer(
        const engine::Device& device, Case& test_case, const MeasureHooks& hooks,
        engine::Timing timing, const engine::Overlap& overlap, const PlantedWork& planted,
        report::CaseResult& counted)
        : device_(device), test_case_(test_case), hooks_(hooks), loop_(device, timing, overlap),
          counted_(counted) {
        if (!planted.pass.empty()) busy_.emplace(device, planted.pass, planted.steps);
    }

    void reset() override { reset_ = true; }

    void frame() override {
        if (hooks_.stop()) throw engine::Interrupted();
        loop_.frame([&](engine::Passes& passes) {
            if (std::exchange(reset_, false)) test_case_.recordReset(passes);
            if (busy_) {
                BusyPasses slowed(passes, *busy_);
                test_case_.frame(slowed);
            } else {
                test_case_.frame(passes);
            }
        });
    }

    void count() override {
        if (hooks_.stop()) throw engine::Interrupted();
        engine::FrameLoop loop(device_, engine::Timing::statistics);
        loop.frame([&](engine::Passes& passes) {
            if (std::exchange(reset_, false)) test_case_.recordReset(passes);
            test_case_.frame(passes);
        });
        const engine::FrameRecord frame = loop.finish().front();
        counted_ = {};
        addTransparency(test_case_, counted_);
        addStatistics(frame, device_, test_case_, counted_);
        addPassStatistics(frame, device_, counted_);
    }

    std::vector<engine::FrameRecord> completed() override { return loop_.completed(); }

    std::vector<engine::FrameRecord> finish() override {
        std::vector<engine::FrameRecord> frames = loop_.finish();
        if (busy_ && !frames.empty()) busy_->checkThatItRan();
        return frames;
    }

    RoundEnd end() override {
        RoundEnd end{.picture = test_case_.picture()};
        end.picture_hash = report::hashBytes(std::as_bytes(std::span(end.picture)));
        end.state_hash = test_case_.stateHash();
        return end;
    }

private:
    const engine::Device& device_;
    Case& test_case_;
    const MeasureHooks& hooks_;
    engine::FrameLoop loop_;
    report::CaseResult& counted_;
    std::optional<BusyPass> busy_;
    bool reset_ = false;
};

// Plays frames without the case's passes; they leave no picture.
class EmptyPlayer : public Player {
public:
    EmptyPlayer(
        const engine::Device& device, const MeasureHooks& hooks, engine::Timing timing,
        std::uint32_t steps)
        : hooks_(hooks), loop_(device, timing) {
        if (steps > 0) work_.emplace(device, steps);
    }

    void reset() override {}
    void frame() override {
        if (hooks_.stop()) throw engine::Interrupted();
        loop_.frame([&](engine::Passes& passes) {
            if (work_)
                passes.pass("work", engine::PassKind::compute, [&](engine::Commands& commands) {
                    work_->record(commands);
                });
        });
    }
    void count() override { frame(); }
    std::vector<engine::FrameRecord> completed() override { return loop_.completed(); }
    std::vector<engine::FrameRecord> finish() override { return loop_.finish(); }
    RoundEnd end() override { return {}; }

private:
    const MeasureHooks& hooks_;
    engine::FrameLoop loop_;
    std::optional<BusyWork> work_;
};

constexpr int kEmptyFrames = 32;
constexpr double kLongestWait = 2.0;  // ms
constexpr std::uint32_t kFewestSteps = 256;
constexpr std::uint32_t kMostSteps = 1u << 30;

// Returns the steps of work that take the device about `wanted` ms; 0 without timestamps. If
// timestamps stand still, the host's clock ends the search.
std::uint32_t calibratedSteps(Stage& stage, double wanted) {
    std::uint32_t steps = kFewestSteps;
    while (steps < kMostSteps) {
        const std::unique_ptr<Player> player = stage.emptyPlayer(engine::Timing::isolated, steps);
        player->frame();
        player->frame();
        const engine::FrameRecord last = player->finish().back();
        if (!last.device) return 0;
        const double time = *last.device;
        if (time >= 0.8 * wanted || last.wall >= 4.0 * kLongestWait) break;
        // If the time is well above that of a barrier, it is proportional to the steps.
        const double factor = time > 0.25 * wanted ? wanted / time : 4.0;
        steps = static_cast<std::uint32_t>(factor * steps) + 1;
    }
    return steps;
}

}  // namespace

EmptySubmission measureEmptySubmission(Stage& stage, double frame) {
    const std::uint32_t steps =
        stage.isProcessor() ? 0 : calibratedSteps(stage, std::min(frame, kLongestWait));
    const std::unique_ptr<Player> player = stage.emptyPlayer(engine::Timing::isolated, steps);
    for (int i = 0; i < kEmptyFrames; ++i) player->frame();
    return emptySubmission(player->finish());
}

DeviceStage::DeviceStage(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks)
    : device_(device), test_case_(test_case), run_(run), hooks_(hooks), watch_(device) {
    if (run.async_compute) device.require(engine::Feature::second_queue, "/run/async_compute");
}

std::unique_ptr<Player> DeviceStage::player(engine::Timing timing) {
    return player(timing, {run_.busy_pass, run_.busy_work});
}

std::unique_ptr<Player> DeviceStage::player(engine::Timing timing, const PlantedWork& planted) {
    const engine::Overlap overlap{
        .frames = run_.frames_in_flight,
        .timestamps = run_.overlapped_stamps ? engine::TimestampPlacement::passes
                                             : engine::TimestampPlacement::frame,
        .async = run_.async_compute};
    return std::make_unique<DevicePlayer>(
        device_, test_case_, hooks_, timing, overlap, planted, counted_);
}

std::unique_ptr<Player> DeviceStage::emptyPlayer(engine::Timing timing, std::uint32_t steps) {
    return std::make_unique<EmptyPlayer>(device_, hooks_, timing, steps);
}

double DeviceStage::seconds() {
    return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::optional<double> DeviceStage::timestampRate() { return engine::timestampRate(device_); }

std::optional<double> DeviceStage::emptyPass() { return engine::emptyPassTime(device_); }

void DeviceStage::pause(double seconds) { std::this_thread::sleep_for(Seconds(seconds)); }

}  // namespace benchmarks::measure
