#include <cstring>

#include "benchmarks/hash.h"
#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/lively.h"

namespace benchmarks::physics {

namespace {

std::vector<glm::vec3> play(const engine::Device& device, hair::Solver solver) {
    Experiment experiment(device, livelyGroom(), livelyHair(solver));
    experiment.advance(experiment.stepsIn(2.0));
    const std::vector<glm::dvec3> points = experiment.positions();  // exactly what was read
    return {points.begin(), points.end()};
}

}  // namespace

void checkStateHash(const engine::Device& device, hair::Solver solver, Findings& findings) {
    const std::vector<glm::vec3> first = play(device, solver);
    const std::vector<glm::vec3> second = play(device, solver);
    double different = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i)
        different += std::memcmp(&first[i], &second[i], sizeof first[i]) != 0 ? 1.0 : 0.0;
    findings.deviation({"vertices that differ in any bit", "count"}, different, 0.0).state_hash =
        hashBytes(std::as_bytes(std::span(first)));
}

}  // namespace benchmarks::physics
