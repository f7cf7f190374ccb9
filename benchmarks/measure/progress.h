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

// Shows which steps (engine/process.h) are under way: on a terminal once they are for two seconds,
// in one line that is rewritten, elsewhere in a line of its own every ten seconds. A program has
// one, for as long as it works; a thread of its own looks twice a second.
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
    std::mutex writing_;
    bool shown_ = false;  // on the terminal
    std::optional<std::chrono::steady_clock::time_point> written_;  // last, where it is no terminal
    std::mutex mutex_;
    std::condition_variable ends_;
    bool over_ = false;
    std::thread thread_;
};

// Pieces of work, of which it is counted how many are done: a step whose words are
// "[3/12] 0:41, about 1:50 left  thesis/density:16  overlapped 12.3 ms +-2.1 %".
class Progress {
public:
    // `done` of the pieces are there already, from an earlier run.
    explicit Progress(std::size_t total, std::size_t done = 0);

    void begin(const std::string& name);
    // What is known of the piece that has begun.
    void update(const std::string& state);
    void update(const SamplingState& state);
    // None is under way: others may write to the terminal.
    void clear();

private:
    std::string words() const;

    std::size_t total_;
    std::size_t first_;  // index of this run's first piece
    std::chrono::steady_clock::time_point start_;
    mutable std::mutex mutex_;
    std::size_t index_;  // of the piece that is played; none before the first begin()
    bool begun_ = false;
    std::string name_;
    std::string state_;
    std::optional<engine::Step> step_;
};

// "overlapped 12.3 ms +-2.1 %"
std::string samplingText(const SamplingState& state);

// "[3/12] 0:41, about 1:50 left": pieces counted from 1; the rest is taken to last as long as the
// pieces `done` in this run did, which took `seconds`; nothing is said while there are none.
std::string progressText(std::size_t number, std::size_t total, std::size_t done, double seconds);

}  // namespace benchmarks::measure
