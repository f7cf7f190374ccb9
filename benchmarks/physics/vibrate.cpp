#include "benchmarks/physics/vibrate.h"

#include "benchmarks/physics/deflection.h"
#include "benchmarks/physics/oscillation.h"

namespace benchmarks::physics {

namespace {

constexpr int kPeriods = 5;
constexpr int kSamplesPerPeriod = 40;

}  // namespace

std::optional<double> measureFrequency(Experiment& experiment, const Vibration& vibration) {
    experiment.place(
        deflected(vibration.shape, vibration.segment, vibration.direction, vibration.sideways));
    const std::uint32_t steps =
        experiment.stepsIn(1.0 / (kSamplesPerPeriod * vibration.expected_frequency));
    std::vector<double> amounts;
    for (int i = 0; i < kPeriods * kSamplesPerPeriod; ++i) {
        experiment.advance(steps);
        amounts.push_back(amountOf(vibration.shape, experiment.positions(), vibration.sideways));
    }
    return frequencyOf(amounts, steps * experiment.timeStep());
}

}  // namespace benchmarks::physics
