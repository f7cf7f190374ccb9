#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/process.h"

// Progress on stderr.
namespace benchmarks::measure {

struct SamplingState;  // measure.h

// Shows the current steps (engine/process.h). On a terminal they appear after two seconds, in one
// line that is rewritten; elsewhere a new line appears every $HAIRBENCH_PROGRESS_SECONDS, or every
// ten. A program has one of these while it works; its own thread checks twice a second.
class ProgressLine {
public:
    ProgressLine();
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

private:
    void show();
    void clear();
    void run();

    bool terminal_;
    std::chrono::duration<double> period_;  // between lines if stderr is not a terminal
    std::mutex writing_;
    bool shown_ = false;  // on the terminal
    std::optional<std::chrono::steady_clock::time_point> written_;  // time of the last line, if not
                                                                    // a terminal
    std::mutex mutex_;
    std::condition_variable ends_;
    bool over_ = false;
    std::thread thread_;
};

// Counts finished pieces of work. It is a step with the text "[3/12] 0:41, about 1:50 left
// thesis/density:16  overlapped 12.3 ms +-2.1 %".
class Progress {
public:
    // `done` pieces exist already from an earlier run.
    explicit Progress(std::size_t total, std::size_t done = 0);

    void begin(const std::string& name);
    // Sets the text about the current piece.
    void update(const std::string& state);
    void update(const SamplingState& state);
    // Ends the step, so that others may write to the terminal.
    void clear();

private:
    std::string words() const;

    std::size_t total_;
    std::size_t first_;  // index of this run's first piece
    std::chrono::steady_clock::time_point start_;
    mutable std::mutex mutex_;
    std::size_t index_;  // of the current piece; none before the first begin()
    bool begun_ = false;
    std::string name_;
    std::string state_;
    std::optional<engine::Step> step_;
};

// "overlapped 12.3 ms +-2.1 %"
std::string samplingText(const SamplingState& state);

// "[3/12] 0:41, about 1:50 left": pieces are counted from 1. The estimate assumes that the rest
// take as long as the `done` pieces of this run, which took `seconds`. There is no estimate while
// `done` is 0.
std::string progressText(std::size_t number, std::size_t total, std::size_t done, double seconds);

}  // namespace benchmarks::measure
