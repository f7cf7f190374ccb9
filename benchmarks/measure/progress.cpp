#include "benchmarks/measure/progress.h"

#include <cmath>
#include <cstdio>
#include <iostream>

#include <sys/ioctl.h>
#include <unistd.h>

#include "benchmarks/measure/measure.h"
#include "benchmarks/report/text.h"

namespace benchmarks::measure {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPlainPeriod{10};

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

// A line that wraps could not be rewritten.
std::string fitting(std::string line) {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 &&
        line.size() >= size.ws_col)
        line.resize(size.ws_col - 1u);
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

Progress::Progress(std::size_t total, std::size_t done)
    : total_(total), first_(done), index_(done), start_(Clock::now()), written_(start_),
      terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::begin(const std::string& name) {
    if (begun_) ++index_;
    begun_ = true;
    name_ = name;
    write({});
}

void Progress::update(const std::string& state) { write(state); }

void Progress::update(const SamplingState& state) { write(samplingText(state)); }

void Progress::clear() const {
    if (terminal_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::write(const std::string& state) {
    if (!terminal_ && Clock::now() - written_ < kPlainPeriod) return;
    std::string line = remaining() + "  " + name_;
    if (!state.empty()) line += "  " + state;
    if (!terminal_) {
        written_ = Clock::now();
        std::cerr << line << std::endl;
        return;
    }
    std::cerr << "\r\033[K" << fitting(std::move(line)) << std::flush;
}

std::string Progress::remaining() const {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    return progressText(index_ + 1, total_, index_ - first_, seconds);
}

}  // namespace benchmarks::measure
