#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/doctor/facts.h"

// Judges facts about the machine: whether timings can be trusted, and what to do where not.
namespace benchmarks::doctor {

enum class Health {
    ok,
    unknown,  // the machine does not tell
    warn,     // timings can be used, with care
    bad,      // they can't be trusted
};

// "ok", "not told", "warn", "bad".
const char* healthName(Health health);

struct Finding {
    std::string check;  // name of the row
    Health health = Health::ok;
    std::string seen;
    std::string advice;  // what to do about it; empty: nothing
};

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

// "12.3 %" of a share of 0.123.
std::string shareText(double share);

// "1.2 % more", "0.3 % less" of shares of 0.012 and -0.003.
std::string changeText(double share);

std::string joined(const std::vector<std::string>& parts, std::string_view between);

}  // namespace benchmarks::doctor
