#include "benchmarks/doctor/checks.h"

namespace benchmarks {

namespace {

constexpr DoctorCheck kChecks[] = {
    {"device", judgeDevice},         {"build", judgeBuild},       {"layers", judgeLayers},
    {"timestamps", judgeTimestamps}, {"pass sum", judgePassSum},  {"pass times", judgeStamps},
    {"repeatability", judgeRepeat},  {"noise", judgeNoise},       {"clocks", judgeClocks},
    {"processor", judgeProcessor},   {"other load", judgeOthers}, {"steal", judgeSteal},
    {"power", judgePower},
};

}  // namespace

const char* healthName(Health health) {
    switch (health) {
    case Health::ok:
        return "ok";
    case Health::unknown:
        return "not told";
    case Health::warn:
        return "warn";
    case Health::bad:
        return "bad";
    }
    return "";
}

std::span<const DoctorCheck> doctorChecks() { return kChecks; }

std::vector<Finding> judgeAll(const Facts& facts) {
    std::vector<Finding> findings;
    for (const DoctorCheck& check : kChecks) {
        Judgement judgement = check.judge(facts);
        findings.push_back(
            {check.name, judgement.health, std::move(judgement.seen), std::move(judgement.advice)});
    }
    return findings;
}

}  // namespace benchmarks
