#include "benchmarks/measure/start.h"

#include <cstdint>
#include <sstream>

#include "hair/simulation/condition.h"
#include "hair/simulation/solvers.h"

namespace benchmarks::measure {
namespace {

using hair::simulation::ConditionLimits;

report::WorstGuide recordOf(const hair::simulation::Worst& worst) {
    return {.value = worst.value, .guide = worst.guide, .guides = worst.guides};
}

std::string guidesText(std::uint32_t count) {
    return std::to_string(count) + (count == 1 ? " guide" : " guides");
}

std::string number(double value) {
    std::ostringstream text;
    text.precision(3);
    text << value;
    return text.str();
}

std::string millimetres(double metres) { return number(1e3 * metres) + " mm"; }

const char* originOf(const hair::Settings& settings) {
    if (settings.simulation.settle_steps > 0 && settings.simulation.solver != hair::Solver::none)
        return "relaxed";
    return settings.groom.file.empty() ? "grown" : "file";
}

}  // namespace

StartInspection judgeStart(
    const hair::simulation::GuideCondition& condition, const hair::simulation::RestBalance* balance,
    const hair::Settings& settings) {
    const hair::SimulationSettings& simulation = settings.simulation;
    StartInspection start{
        .record = {
            .from = originOf(settings),
            .rest = simulation.rest == hair::RestShape::balanced ? "balanced" : "groom",
            .stretch = recordOf(condition.stretch),
            .depth = recordOf(condition.depth),
            .speed = recordOf(condition.speed)}};
    std::vector<std::string>& warnings = start.warnings;
    const ConditionLimits limits;
    // The thesis's iterations stretch hair. Scenes that select them get the value but no warning.
    const bool keeps_lengths = simulation.solver != hair::Solver::shape ||
                               (simulation.length.method == hair::LengthMethod::tridiagonal &&
                                simulation.length.iterations > 0);
    const auto& [stretch, depth, speed] = condition;
    if (stretch.guides > 0 && keeps_lengths)
        warnings.push_back(
            "hair starts torn: a segment of guide " + std::to_string(stretch.guide) + " is " +
            number(stretch.value) + " times its rest length; " + guidesText(stretch.guides) +
            " beyond " + number(limits.stretch) + " times");
    if (depth.guides > 0)
        warnings.push_back(
            "hair starts inside a body: guide " + std::to_string(depth.guide) + " is " +
            millimetres(depth.value) + " deep; " + guidesText(depth.guides) + " deeper than " +
            millimetres(limits.depth));
    if (speed.guides > 0)
        warnings.push_back(
            "hair has not settled: guide " + std::to_string(speed.guide) + " moves at " +
            millimetres(speed.value) + "/s; " + guidesText(speed.guides) + " faster than " +
            millimetres(limits.speed) + "/s; raise /simulation/settle_steps (" +
            std::to_string(simulation.settle_steps) + ")");
    if (!balance) return start;
    start.record.stiffened = balance->stiffened;
    start.record.stiffest = balance->stiffest;
    start.record.unbalanced = static_cast<std::uint32_t>(balance->unbalanced.size());
    if (!balance->unbalanced.empty())
        warnings.push_back(
            "hair sags: guide " + std::to_string(balance->unbalanced.front()) +
            (simulation.solver == hair::Solver::shape
                 ? " can't be balanced if nothing pulls it to its place "
                   "(/simulation/global/stiffness is 0)"
                 : " can't be balanced by a stiffening of " + number(simulation.most_stiffening) +
                       " (/simulation/most_stiffening)") +
            "; " + guidesText(*start.record.unbalanced) + " in all");
    return start;
}

StartInspection inspectStart(const Case& test_case) {
    StartInspection start =
        judgeStart(test_case.condition(), test_case.balance(), test_case.settings());
    const std::vector<std::string>& of_file = test_case.groom().warnings;
    start.warnings.insert(start.warnings.end(), of_file.begin(), of_file.end());
    return start;
}

}  // namespace benchmarks::measure
