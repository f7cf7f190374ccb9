#pragma once

#include <span>
#include <vector>

#include "benchmarks/doctor/facts.h"
#include "benchmarks/doctor/finding.h"

namespace benchmarks {

struct Judgement {
    Health health = Health::ok;
    std::string seen;
    std::string advice{};
};

// A row of the doctor's table.
struct DoctorCheck {
    const char* name;
    Judgement (*judge)(const Facts& facts);
};

// Every check, in the order in which they are shown. A new one is a row here.
std::span<const DoctorCheck> doctorChecks();

// What every check says of the facts.
std::vector<Finding> judgeAll(const Facts& facts);

// Of timings.
Judgement judgeTimestamps(const Facts& facts);
Judgement judgePassSum(const Facts& facts);
Judgement judgeStamps(const Facts& facts);
Judgement judgeRepeat(const Facts& facts);
Judgement judgeNoise(const Facts& facts);
// Of the program.
Judgement judgeDevice(const Facts& facts);
Judgement judgeBuild(const Facts& facts);
Judgement judgeLayers(const Facts& facts);
// Of the machine.
Judgement judgeClocks(const Facts& facts);
Judgement judgeProcessor(const Facts& facts);
Judgement judgeOthers(const Facts& facts);
Judgement judgeSteal(const Facts& facts);
Judgement judgePower(const Facts& facts);

}  // namespace benchmarks
