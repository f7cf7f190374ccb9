#include "benchmarks/report/verdict.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/text.h"
#include "engine/instance.h"

namespace benchmarks::report {

const char* trustedName(Trusted level) {
    switch (level) {
    case Trusted::trusted:
        return "trusted";
    case Trusted::doubtful:
        return "doubtful";
    case Trusted::untrusted:
        break;
    }
    return "untrusted";
}

// ---- Rules --------------------------------------------------------------------------------------

namespace {

Trusted disturbance(double share, double little, double much, bool of_frames) {
    if (share <= little) return Trusted::trusted;
    return share > much && of_frames ? Trusted::untrusted : Trusted::doubtful;
}

}  // namespace

namespace {

// Returns nothing if the environment does not have a type, or has an unknown one.
std::optional<engine::DeviceType> deviceTypeIn(const scene::Json& environment) {
    using enum engine::DeviceType;
    const std::string name = scene::textAt(environment, "/device/type");
    for (const engine::DeviceType type : {discrete, integrated, virtual_gpu, cpu, other})
        if (name == engine::deviceTypeName(type)) return type;
    return std::nullopt;
}

}  // namespace

bool isSoftwareDevice(const scene::Json& environment) {
    return deviceTypeIn(environment) == engine::DeviceType::cpu;
}

bool sharesProcessors(std::optional<engine::DeviceType> device_type) {
    return device_type == engine::DeviceType::cpu || device_type == engine::DeviceType::integrated;
}

Trusted judgeOtherLoad(double share, bool shares_processors) {
    return disturbance(share, kLittleLoad, kMuchLoad, shares_processors);
}

Trusted judgeSteal(double share, bool software) {
    return disturbance(share, kLittleSteal, kMuchSteal, software);
}

Trusted judgeBuild(const BuildRecord& build) {
    return build.flags.find("-fsanitize") != std::string::npos || !build.type.starts_with("Rel")
               ? Trusted::untrusted
               : Trusted::trusted;
}

Trusted judgePassSum(double sum) {
    return std::abs(sum - 1.0) <= kTrustTolerance ? Trusted::trusted : Trusted::untrusted;
}

Trusted judgeClock(const Conditions& conditions) {
    if (isThrottled(conditions, {}, {})) return Trusted::untrusted;
    return conditions.throttle_reasons.empty() ? Trusted::trusted : Trusted::doubtful;
}

bool isHeatOrPower(std::string_view reason) {
    return std::ranges::any_of(
        std::initializer_list<std::string_view>{"power", "thermal", "hardware slowdown", "current"},
        [&](std::string_view word) { return reason.find(word) != std::string_view::npos; });
}

bool isFullyLoaded(const Conditions& round) { return round.load.value_or(0.0) >= 0.9; }

namespace {

// A board controls its clock so that it stays at these limits.
bool isBoardLimit(std::string_view reason) {
    return reason == kPowerCap || reason == kCurrentLimit;
}

}  // namespace

void HighestClocks::raise(const Conditions& round) {
    raise(HighestClocks{round.clock_mhz.value_or(0.0), round.memory_clock_mhz.value_or(0.0)});
}

void HighestClocks::raise(const HighestClocks& others) {
    shaders = std::max(shaders, others.shaders);
    memory = std::max(memory, others.memory);
}

bool isThrottled(
    const Conditions& round, const HighestClocks& held, const HighestClocks& held_before) {
    for (const std::string& reason : round.throttle_reasons)
        if (isHeatOrPower(reason) && (!isBoardLimit(reason) || !round.clock_mhz ||
                                      *round.clock_mhz < kCappedShare * held.shaders))
            return true;
    const auto is_low = [&](const std::optional<double>& clock, double highest, double before) {
        return clock && (*clock < kHeldShare * highest ||
                         (isFullyLoaded(round) && *clock < kThrottledShare * before));
    };
    return is_low(round.low_clock_mhz, held.shaders, held_before.shaders) ||
           is_low(round.memory_clock_mhz, held.memory, held_before.memory);
}

// ---- Verdict on a case --------------------------------------------------------------------------

namespace {

using scene::Json;

std::optional<double> numberIn(const Json& object, const char* pointer) {
    const Json::json_pointer place(pointer);
    if (!object.contains(place) || !object.at(place).is_number()) return std::nullopt;
    return object.at(place).get<double>();
}

// Returns the array, or an empty one if it is absent.
const Json& arrayIn(const Json& object, const char* pointer) {
    static const Json none = Json::array();
    const Json::json_pointer place(pointer);
    return object.contains(place) && object.at(place).is_array() ? object.at(place) : none;
}

// "73 %": a whole number, except below 10.
std::string briefShare(double share) {
    const double percent = share * 100.0;
    return plainNumber(percent < 9.95 ? std::round(percent * 10.0) / 10.0 : std::round(percent)) +
           " %";
}

void add(std::vector<Doubt>& doubts, Doubt doubt) {
    if (doubt.level != Trusted::trusted) doubts.push_back(std::move(doubt));
}

void judgeLoad(const Json& environment, const Json& result, std::vector<Doubt>& doubts) {
    const bool shares = sharesProcessors(deviceTypeIn(environment));
    if (const auto share = numberIn(result, "/conditions/other_load"))
        add(doubts, {.check = "other load",
                     .level = judgeOtherLoad(*share, shares),
                     .brief = "other load " + briefShare(*share),
                     .text = shareText(*share) + " of all processors' time was used by others",
                     .size = *share});
    if (const auto share = numberIn(result, "/conditions/steal"))
        add(doubts, {.check = "steal",
                     .level = judgeSteal(*share, isSoftwareDevice(environment)),
                     .brief = "steal " + briefShare(*share),
                     .text = shareText(*share) +
                             " of all processors' time was given to others by the hypervisor",
                     .size = *share});
}

void judgeClocks(const Json& result, std::vector<Doubt>& doubts) {
    Conditions conditions;
    conditions.clock_mhz = numberIn(result, "/conditions/clock_mhz");
    std::string reasons;
    for (const Json& each : arrayIn(result, "/conditions/throttle_reasons")) {
        if (!each.is_string()) continue;
        conditions.throttle_reasons.push_back(each.get<std::string>());
        reasons += (reasons.empty() ? "" : ", ") + conditions.throttle_reasons.back();
    }
    const Trusted level = judgeClock(conditions);
    add(doubts, {.check = "clocks",
                 .level = level,
                 .brief = level == Trusted::untrusted ? "throttled" : "clock limited",
                 .text = "the device's clock was held back: " + reasons});
}

bool hasWarning(const Json& result, const char* beginning) {
    return std::ranges::any_of(arrayIn(result, "/trust/warnings"), [&](const Json& each) {
        return each.is_string() && each.get_ref<const std::string&>().starts_with(beginning);
    });
}

// Since 1.3 there is a verdict on timestamps; before, there was only a sentence.
bool areTimestampsWrong(const Json& result) {
    return scene::textAt(result, "/trust/timestamps") == "wrong" ||
           hasWarning(result, "timestamps are not trusted");
}

void judgePassSums(const Json& environment, const Json& result, std::vector<Doubt>& doubts) {
    const auto judge = [&](const char* pointer, const char* whole, bool stamps_right) {
        const auto sum = numberIn(result, pointer);
        if (!sum || judgePassSum(*sum) == Trusted::trusted) return false;
        doubts.push_back(
            {.check = "pass sum",
             .level = stamps_right ? Trusted::doubtful : judgePassSum(*sum),
             .brief = "pass sum " + briefShare(*sum),
             .text = "the isolated passes add up to " + shareText(*sum) + " of " + whole,
             .size = std::abs(*sum - 1.0)});
        return true;
    };
    if (isSoftwareDevice(environment)) {
        judge("/trust/pass_sum_over_wall", "the wall clock", false);
        return;
    }
    if (judge("/trust/pass_sum_over_device", "the device's own time", false)) return;
    // A submission may take longer than a frame. The run warns only beyond what submissions vary
    // by. If the passes' timestamps agreed with the host's clock, only the host's part is doubtful.
    if (hasWarning(result, "the passes add up to"))
        judge(
            "/trust/pass_sum_over_work", "the wall clock minus a submission",
            scene::textAt(result, "/trust/timestamps") == "right");
}

void judgePasses(const Json& environment, const Json& result, std::vector<Doubt>& doubts) {
    judgePassSums(environment, result, doubts);
    if (areTimestampsWrong(result))
        add(doubts, {.check = "pass times",
                     .level = Trusted::untrusted,
                     .brief = "timestamps",
                     .text = "timestamps differ from the CPU's clock"});
}

// Rounds of a mode, or modes, that made other pictures or states did other work. Reports say so in
// a warning only.
void judgeRepetition(const Json& result, std::vector<Doubt>& doubts) {
    for (const Json& each : arrayIn(result, "/trust/warnings")) {
        if (!each.is_string()) continue;
        const auto& warning = each.get_ref<const std::string&>();
        if (!warning.ends_with(" made different pictures") &&
            !warning.ends_with(" made different states"))
            continue;
        add(doubts, {.check = "repeatability",
                     .level = Trusted::untrusted,
                     .brief = "different work",
                     .text = warning});
        return;
    }
}

void judgeSteadiness(const Json& result, std::vector<Doubt>& doubts) {
    std::string modes;
    for (const Json& each : arrayIn(result, "/sampling"))
        if (each.is_object() && each.value("steady", Json()) == false)
            modes += (modes.empty() ? "" : ", ") + scene::textAt(each, "/mode");
    if (!modes.empty())
        add(doubts, {.check = "drift",
                     .level = Trusted::doubtful,
                     .brief = "drift",
                     .text = "times drifted to the end: " + modes});
}

void judgeNoise(const Json& result, std::vector<Doubt>& doubts) {
    const auto width = relativeHalfInterval(result);
    if (!width)
        add(doubts, {.check = "noise",
                     .level = Trusted::doubtful,
                     .brief = "no interval",
                     .text = "too few frames for an interval of the frame time"});
    else if (*width > kWideInterval)
        add(doubts, {.check = "noise",
                     .level = Trusted::doubtful,
                     .brief = "noise " + briefShare(*width),
                     .text = shareText(*width) +
                             " of the frame time is half the 95 % interval of its median",
                     .size = *width});
}

std::string reasonText(const Doubt& doubt) { return doubt.check + ": " + doubt.text; }

}  // namespace

std::optional<double> relativeHalfInterval(const Json& result) {
    const auto of_frame = [&](const char* member) {
        return numberIn(result, ("/metrics/frame.time/" + std::string(member)).c_str());
    };
    const auto middle = of_frame("median"), lower = of_frame("interval/lower"),
               upper = of_frame("interval/upper");
    if (!middle || !lower || !upper || *middle <= 0.0) return std::nullopt;
    return (*upper - *lower) / 2.0 / *middle;
}

std::vector<Doubt> judgeEnvironment(const Json& environment) {
    std::vector<Doubt> doubts;
    if (environment.contains("build")) {
        BuildRecord build;
        build.type = scene::textAt(environment, "/build/type");
        build.flags = scene::textAt(environment, "/build/flags");
        const std::string type = build.type.empty() ? "no build type" : build.type;
        add(doubts, {.check = "build",
                     .level = judgeBuild(build),
                     .brief = "build",
                     .text = type + (build.flags.empty() ? "" : " (" + build.flags + ')') +
                             " is no build to measure with"});
    }
    if (scene::textAt(environment, "/validation") == "true")
        add(doubts, {.check = "layers",
                     .level = Trusted::untrusted,
                     .brief = "validation",
                     .text = "the validation layer is on"});
    return doubts;
}

namespace {

// Figures of compiled shaders are no times.
bool hasOnlyShaders(const Json& result) {
    const auto metrics = result.find("metrics");
    if (metrics == result.end() || metrics->empty()) return false;
    for (const auto& [name, metric] : metrics->items())
        if (metricNamed(name).of != MetricOf::shader) return false;
    return true;
}

}  // namespace

std::optional<CaseVerdict> judgeCase(const Json& environment, const Json& result) {
    if (scene::textAt(result, "/status") != statusName(Status::ok)) return std::nullopt;
    if (hasOnlyShaders(result)) return std::nullopt;
    CaseVerdict verdict{.doubts = judgeEnvironment(environment)};
    judgePasses(environment, result, verdict.doubts);
    judgeRepetition(result, verdict.doubts);
    judgeClocks(result, verdict.doubts);
    judgeLoad(environment, result, verdict.doubts);
    judgeSteadiness(result, verdict.doubts);
    judgeNoise(result, verdict.doubts);
    std::ranges::stable_sort(verdict.doubts, std::ranges::greater(), &Doubt::level);
    if (!verdict.doubts.empty()) verdict.level = verdict.doubts.front().level;
    return verdict;
}

std::string verdictText(const CaseVerdict& verdict) {
    std::string reasons;
    for (const Doubt& each : verdict.doubts)
        if (each.level == verdict.level) reasons += (reasons.empty() ? "" : ", ") + each.brief;
    return trustedName(verdict.level) + (reasons.empty() ? "" : " (" + reasons + ')');
}

std::string reasonsText(const CaseVerdict& verdict) {
    std::string text;
    for (const Doubt& each : verdict.doubts) text += (text.empty() ? "" : "; ") + reasonText(each);
    return text;
}

Json verdictJson(const CaseVerdict& verdict) {
    Json json = {{"verdict", trustedName(verdict.level)}, {"reasons", Json::array()}};
    for (const Doubt& each : verdict.doubts) json["reasons"].push_back(reasonText(each));
    return json;
}

void putVerdict(const Json& environment, Json& result) {
    const auto verdict = judgeCase(environment, result);
    if (!verdict || !result.contains("trust")) return;
    const Json members = verdictJson(*verdict);
    for (const auto& [name, value] : members.items()) result["trust"][name] = value;
}

// ---- Verdicts on a report -----------------------------------------------------------------------

void Verdicts::add(const Json& environment, const Json& result) {
    const auto verdict = judgeCase(environment, result);
    if (!verdict) return;
    ++counts_[verdict->level];
    for (const Doubt& doubt : verdict->doubts) {
        Shared& shared = shared_[{doubt.level, doubt.check}];
        if (shared.cases++ == 0 || doubt.size > shared.worst.size) shared.worst = doubt;
    }
}

std::size_t Verdicts::count(Trusted level) const {
    const auto found = counts_.find(level);
    return found == counts_.end() ? 0 : found->second;
}

Trusted Verdicts::worst() const {
    return counts_.empty() ? Trusted::trusted : counts_.rbegin()->first;
}

std::string Verdicts::counts() const {
    std::string text;
    for (const auto& [level, cases] : counts_)
        text += (text.empty() ? "" : ", ") + countText(cases) + ' ' + trustedName(level);
    return text;
}

std::string Verdicts::summary() const {
    const Trusted level = worst();
    if (level == Trusted::trusted) return {};
    const Shared* most = nullptr;
    for (const auto& [key, shared] : shared_)
        if (key.first == level && (!most || shared.cases > most->cases)) most = &shared;
    const std::size_t bad = count(Trusted::untrusted), doubtful = count(Trusted::doubtful);
    const std::size_t all = count(Trusted::trusted) + doubtful + bad;
    const auto are = [](std::size_t cases) { return cases == 1 ? " is " : " are "; };
    const std::size_t first = bad > 0 ? bad : doubtful;
    std::string text = countText(first) + " of " + countText(all, "case") + are(first) +
                       (bad > 0 ? "not to be trusted" : "doubtful");
    if (bad > 0 && doubtful > 0) text += ", " + countText(doubtful) + are(doubtful) + "doubtful";
    const std::string& reason = most->worst.text;
    const bool is_share = std::isdigit(static_cast<unsigned char>(reason.front())) != 0;
    return text + ": " + (is_share && most->cases > 1 ? "up to " : "") + reason +
           "; \"hairbench doctor\" says more";
}

Verdicts verdictsOf(const Json& report) {
    const Json environment = report.value("environment", Json::object());
    Verdicts verdicts;
    for (const Json& each : report.at("cases")) verdicts.add(environment, each);
    return verdicts;
}

}  // namespace benchmarks::report
