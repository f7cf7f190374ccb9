#include "engine/steps.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/process.h"

namespace engine {
namespace {

using StepClock = std::chrono::steady_clock;

// Steps belong to the process, like its interrupts.
struct Steps {
    std::mutex mutex;
    std::vector<const Step*> under_way;  // in the order of their start
    std::function<void()> ended;
    bool forgotten = false;
};

Steps& steps() {
    static Steps& all = *new Steps;  // never destroyed: threads may need it until the very end
    return all;
}

void begin(const Step& step) {
    const std::lock_guard lock(steps().mutex);
    steps().under_way.push_back(&step);
}

}  // namespace

Step::Step(std::string name, std::uint64_t parts)
    : name_(std::move(name)), parts_(parts), start_(StepClock::now()) {
    begin(*this);
}

Step::Step(std::function<std::string()> words)
    : words_(std::move(words)), start_(StepClock::now()) {
    begin(*this);
}

Step::~Step() {
    std::function<void()> ended;
    {
        const std::lock_guard lock(steps().mutex);
        std::erase(steps().under_way, this);
        if (steps().under_way.empty()) ended = steps().ended;
    }
    if (ended) ended();  // outside the lock: observers of the steps may wait for this call
}

void Step::advance(std::uint64_t parts) {
    done_.fetch_add(parts, std::memory_order_relaxed);
    checkInterrupted();
}

std::string Step::text() const {
    if (words_) return words_();
    if (parts_ == 0) return name_;
    return name_ + ", " + std::to_string(std::min(done_.load(), parts_)) + " of " +
           std::to_string(parts_);
}

StepsUnderWay stepsUnderWay() {
    const std::lock_guard lock(steps().mutex);
    StepsUnderWay all{};
    if (steps().forgotten) return all;
    for (const Step* each : steps().under_way) {
        if (all.text.empty())
            all.start = each->start();
        else
            all.text += "  ";
        all.text += each->text();
    }
    return all;
}

void forgetSteps() {
    std::function<void()> ended;
    {
        const std::lock_guard lock(steps().mutex);
        steps().forgotten = true;
        ended = steps().ended;
    }
    if (ended) ended();
}

void onceStepsEnd(std::function<void()> ended) {
    const std::lock_guard lock(steps().mutex);
    steps().ended = std::move(ended);
}

}  // namespace engine
