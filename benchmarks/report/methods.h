#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "benchmarks/scene/json.h"

// Describes in words how a report's numbers were measured.
namespace benchmarks::report {

// Returns a paragraph for the methods section of a paper, in English: device, driver, clocks,
// warm-up, samples, statistic and interval, and what was left out. Hoefler and Belli, Scientific
// Benchmarking of Parallel Computing Systems (SC 2015, doi 10.1145/2807591.2807644), ask for these
// in their rules 2 (what was measured and what not), 5 and 6 (nondeterminism, distributions,
// intervals), 9 (the whole setting) and 10 (how time was taken). Leaves out whatever the report
// does not know. `report` is a whole report; its samples may be absent.
std::string methodsText(const scene::Json& report);

// Builds the same paragraph from cases that are visited one by one and not kept.
class Methods {
public:
    // `header` is a report with or without its cases. It must outlive this.
    explicit Methods(const scene::Json& header) : header_(header) {}

    void add(const scene::Json& result);
    std::string text() const;

private:
    struct Range {
        double least = std::numeric_limits<double>::infinity();
        double most = -std::numeric_limits<double>::infinity();

        bool empty() const { return most < least; }
        void add(double value);
        std::string text() const;  // "3" or "3 to 17"
    };

    std::string machineText() const;
    std::string casesText() const;
    std::string roundsText() const;
    std::string clocksChoiceText() const;
    std::string clocksText() const;
    std::string energyText() const;
    std::string statisticText() const;
    std::string trustText() const;

    const scene::Json& header_;
    std::uint64_t measured_ = 0, failed_ = 0, skipped_ = 0;
    std::uint64_t warned_ = 0;
    std::uint64_t right_stamps_ = 0, wrong_stamps_ = 0;  // cases, by their timestamps
    std::uint64_t warmup_rounds_ = 0, throttled_rounds_ = 0;
    std::uint64_t locked_ = 0, free_ = 0;  // measured cases, by the choice in /run/clocks
    std::uint64_t counted_energies_ = 0, power_energies_ = 0;  // cases, by source
    Range plays_;
    Range clocks_, lowest_clocks_;  // MHz
    Range temperatures_;  // degrees Celsius
};

}  // namespace benchmarks::report
