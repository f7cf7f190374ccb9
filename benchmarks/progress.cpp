#include "benchmarks/progress.h"

#include <cstdio>
#include <iostream>

#include <unistd.h>

namespace benchmarks {

namespace {

using Clock = std::chrono::steady_clock;

std::string minutes(double seconds) {
    char text[32];
    const int whole = static_cast<int>(seconds + 0.5);
    std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
    return text;
}

}  // namespace

Progress::Progress(std::size_t total)
    : total_(total), start_(Clock::now()), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::begin(const std::string& name) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string line =
        "[" + std::to_string(done_ + 1) + "/" + std::to_string(total_) + "] " + minutes(elapsed);
    if (done_ > 0) {
        const double each = elapsed / static_cast<double>(done_);
        line += ", about " + minutes(each * static_cast<double>(total_ - done_)) + " left";
    }
    line += "  " + name;
    ++done_;
    if (terminal_) {
        std::cerr << "\r\033[K" << line << std::flush;
    } else {
        std::cerr << line << '\n';
    }
}

void Progress::clear() const {
    if (terminal_) std::cerr << "\r\033[K" << std::flush;
}

}  // namespace benchmarks
