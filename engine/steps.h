#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// What this process is doing, for whoever looks on.
namespace engine {

// A step that may be long, under way for as long as this is there. Steps of one thread lie within
// one another.
class Step {
public:
    // What is done: "grows strands", and of how many parts. With them the words that others see are
    // "grows strands, 31000 of 100000"; without (0) they are the name alone.
    explicit Step(std::string name, std::uint64_t parts = 0);
    // Its words are made anew each time they are asked for, by any thread.
    explicit Step(std::function<std::string()> words);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

    // So many parts more are done. Throws Interrupted where an interrupt came (engine/process.h):
    // a step that says where it is can be ended there. For any thread.
    void advance(std::uint64_t parts = 1);

    std::string text() const;
    std::chrono::steady_clock::time_point start() const { return start_; }

private:
    std::string name_;
    std::uint64_t parts_ = 0;
    std::atomic<std::uint64_t> done_ = 0;
    std::function<std::string()> words_;
    std::chrono::steady_clock::time_point start_;
};

struct StepsUnderWay {
    std::string text;  // of all, outermost first
    std::chrono::steady_clock::time_point start;  // of the outermost; without a text, of nothing
};
StepsUnderWay stepsUnderWay();

// From now on none is said to be under way: the program ends.
void forgetSteps();

// Called by the thread whose step ends once none is under way; no function: nobody. To be set while
// none is.
void onceStepsEnd(std::function<void()> ended);

}  // namespace engine
