#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// Progress of this process, for observers.
namespace engine {

// A step that may be long, under way during this object's lifetime. Steps of one thread nest.
class Step {
public:
    // `name`: the work, such as "grows strands". `parts`: how many parts it has. The text is then
    // "grows strands, 31000 of 100000", or for 0 parts the name alone.
    explicit Step(std::string name, std::uint64_t parts = 0);
    // `words` returns the text; any thread may call it.
    explicit Step(std::function<std::string()> words);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

    // Adds to the parts done. Throws Interrupted after an interrupt (engine/process.h): a step can
    // be ended where it reports progress. Thread-safe.
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
    std::string text;  // of all steps, outermost first
    std::chrono::steady_clock::time_point start;  // of the outermost; meaningless without text
};
StepsUnderWay stepsUnderWay();

// From now on no step is reported: the program is ending.
void forgetSteps();

// Sets a function that is called once no step is under way, by the thread that ended the last step;
// empty: none. Set it only while no step is under way.
void onceStepsEnd(std::function<void()> ended);

}  // namespace engine
