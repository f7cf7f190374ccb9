#pragma once

#include <algorithm>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/facts.h"
#include "engine/instance.h"

namespace benchmarks::doctor {

// Returns a machine without faults: a discrete device with locked clocks, on mains, idle.
inline Facts goodFacts() {
    Facts facts;
    facts.device = {.name = "Fast", .type = engine::DeviceType::discrete};
    facts.build = {
        .build =
            {.version = "0.1.0",
             .commit = "abc",
             .compiler = "GNU 12.2.0",
             .type = "Release",
             .flags = "-O3 -DNDEBUG",
             .dirty = false},
        .assertions = false};
    facts.timestamps = {.valid_bits = 64, .period_ns = 1.0, .step_ns = 32.0, .gap_ns = 960.0};
    facts.passes = {
        .sum = {.over_wall = 0.4, .over_device = 0.99, .over_work = 0.97, .incomplete = false},
        .faults = {}};
    facts.repeat = {.same_picture = true, .same_state = true};
    for (int pair = 0; pair < 12; ++pair) {
        facts.repeat.frame.push_back(pair % 2 == 0 ? 0.002 : -0.002);
        facts.repeat.cpu.push_back(pair % 2 == 0 ? 0.001 : -0.001);
    }
    facts.clocks = ClockFacts{
        .lowest_mhz = 1500,
        .highest_mhz = 1500,
        .held = true,
        .conditions = {.clock_mhz = 1500, .temperature = 50}};
    facts.processor = {.governors = {"performance"}, .count = 16};
    facts.load = {.steal = 0.0, .others = 0.01};
    facts.on_battery = false;
    return facts;
}

// Returns the same with a software device.
inline Facts softwareFacts() {
    Facts facts = goodFacts();
    facts.device = {.name = "Soft", .type = engine::DeviceType::cpu};
    facts.passes.sum.over_wall = 0.99;
    facts.clocks.reset();
    return facts;
}

// Returns the finding of the check of this name.
inline Finding findingOf(const Facts& facts, const std::string& check) {
    const std::vector<Finding> findings = judgeAll(facts);
    const auto found = std::ranges::find(findings, check, &Finding::check);
    return found == findings.end() ? Finding{"no such check", Health::bad, "", ""} : *found;
}

}  // namespace benchmarks::doctor
