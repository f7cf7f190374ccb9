#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/doctor/facts.h"
#include "benchmarks/report/verdict.h"

// Judges facts about the machine: whether timings can be trusted, and what to do if not.
namespace benchmarks::doctor {

enum class Health {
    ok,
    unknown,  // the machine does not tell
    warn,     // timings can be used with care
    bad,      // timings can't be trusted
};

// The health that a level of trust means: ok, warn or bad.
Health healthOf(report::Trusted level);

// "ok", "unknown", "warn", "bad".
const char* healthName(Health health);

struct Finding {
    std::string check;  // name of the row
    Health health = Health::ok;
    std::string seen;
    std::string advice;  // remedy; empty: none needed
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

// All checks in display order. A new check is a row of the table in checks.cpp.
std::span<const DoctorCheck> doctorChecks();

// The findings of all checks for the facts.
std::vector<Finding> judgeAll(const Facts& facts);

}  // namespace benchmarks::doctor
