#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace benchmarks {

// "[3/12] 0:41, about 1:50 left  thesis/density:16" on stderr: one line that is rewritten on a
// terminal, a line per piece of work elsewhere.
class Progress {
public:
    explicit Progress(std::size_t total);

    void begin(const std::string& name);
    void clear() const;

private:
    std::size_t total_;
    std::size_t done_ = 0;
    std::chrono::steady_clock::time_point start_;
    bool terminal_;
};

}  // namespace benchmarks
