#pragma once

#include <chrono>
#include <cstddef>
#include <string>

// Progress on stderr.
namespace benchmarks::measure {

struct SamplingState;  // measure.h

// "[3/12] 0:41, about 1:50 left  thesis/density:16  overlapped 12.3 ms +-2.1 %" on stderr: one line
// that is rewritten on a terminal; elsewhere a line of its own every ten seconds.
class Progress {
public:
    // `done` of the pieces are there already, from an earlier run.
    explicit Progress(std::size_t total, std::size_t done = 0);

    void begin(const std::string& name);
    // What is known of the piece that has begun.
    void update(const std::string& state);
    void update(const SamplingState& state);
    void clear() const;

private:
    void write(const std::string& state);
    std::string remaining() const;

    std::size_t total_;
    std::size_t first_;  // index of this run's first piece
    std::size_t index_;  // of the piece that is played; none before the first begin()
    bool begun_ = false;
    std::string name_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point written_;  // last, where it is no terminal
    bool terminal_;
};

// "overlapped 12.3 ms +-2.1 %"
std::string samplingText(const SamplingState& state);

// "[3/12] 0:41, about 1:50 left": pieces counted from 1; the rest is taken to last as long as the
// pieces `done` in this run did, which took `seconds`; nothing is said while there are none.
std::string progressText(std::size_t number, std::size_t total, std::size_t done, double seconds);

}  // namespace benchmarks::measure
