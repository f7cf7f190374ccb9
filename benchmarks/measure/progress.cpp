#include "benchmarks/measure/progress.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "benchmarks/measure/measure.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/system/process.h"

namespace benchmarks::measure {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{500};
constexpr std::chrono::seconds kLong{2};  // minimum duration of a step that is shown

std::chrono::duration<double> periodOfLines() {
    const char* const wanted = std::getenv("HAIRBENCH_PROGRESS_SECONDS");
    const double seconds = wanted ? std::strtod(wanted, nullptr) : 0.0;
    return std::chrono::duration<double>(seconds > 0.0 ? seconds : 10.0);
}

std::string clockText(double seconds) {
    char text[48];
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 3600)
        std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
    else
        std::snprintf(
            text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
    return text;
}

// Cuts the line to the terminal's width, because a wrapped line could not be rewritten.
std::string fitting(std::string line) {
    const std::size_t width = engine::system::terminalWidth();
    if (width > 1 && line.size() >= width) line.resize(width - 1);
    return line;
}

}  // namespace

std::string samplingText(const SamplingState& state) {
    std::string text = state.mode + ' ' + report::shortNumber(state.median) + " ms";
    if (state.relative_half_width && std::isfinite(*state.relative_half_width))
        text += " +-" + report::shortNumber(*state.relative_half_width * 100.0) + " %";
    return text;
}

std::string progressText(std::size_t number, std::size_t total, std::size_t done, double seconds) {
    std::string text =
        '[' + std::to_string(number) + '/' + std::to_string(total) + "] " + clockText(seconds);
    if (done == 0) return text;
    const double each = seconds / static_cast<double>(done);
    return text + ", about " + clockText(each * static_cast<double>(total - number + 1)) + " left";
}

// ---- The line -----------------------------------------------------------------------------------

ProgressLine::ProgressLine() : terminal_(engine::system::hasTerminal()), period_(periodOfLines()) {
    engine::onceStepsEnd([this] { clear(); });
    thread_ = std::thread([this] { run(); });
}

ProgressLine::~ProgressLine() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    ends_.notify_all();
    thread_.join();
    engine::onceStepsEnd({});
    clear();
}

void ProgressLine::run() {
    std::unique_lock lock(mutex_);
    while (!ends_.wait_for(lock, kLook, [this] { return over_; })) show();
}

// Steps that end meanwhile wait until the line is written; then it is cleared.
void ProgressLine::show() {
    const std::lock_guard lock(writing_);
    const Clock::time_point now = Clock::now();
    if (written_ && now - *written_ < period_) return;
    const engine::StepsUnderWay steps = engine::stepsUnderWay();
    if (steps.text.empty()) return;
    if (now - steps.start < (terminal_ ? std::chrono::duration<double>(kLong) : period_)) return;
    if (terminal_) {
        shown_ = true;
        std::cerr << "\r\033[K" << fitting(engine::shownText(steps.text)) << std::flush;
    } else {
        written_ = now;
        std::cerr << engine::shownText(steps.text) << std::endl;
    }
}

void ProgressLine::clear() {
    const std::lock_guard lock(writing_);
    if (std::exchange(shown_, false)) std::cerr << "\r\033[K" << std::flush;
}

// ---- Pieces of work -----------------------------------------------------------------------------

Progress::Progress(std::size_t total, std::size_t done)
    : total_(total), first_(done), start_(Clock::now()), index_(done) {}

void Progress::begin(const std::string& name) {
    {
        const std::lock_guard lock(mutex_);
        if (begun_) ++index_;
        begun_ = true;
        name_ = name;
        state_.clear();
    }
    if (!step_) step_.emplace([this] { return words(); });
}

void Progress::update(const std::string& state) {
    const std::lock_guard lock(mutex_);
    state_ = state;
}

void Progress::update(const SamplingState& state) { update(samplingText(state)); }

void Progress::clear() { step_.reset(); }

std::string Progress::words() const {
    const std::lock_guard lock(mutex_);
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string line = progressText(index_ + 1, total_, index_ - first_, seconds) + "  " + name_;
    if (!state_.empty()) line += "  " + state_;
    return line;
}

}  // namespace benchmarks::measure
