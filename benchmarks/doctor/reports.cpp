#include "benchmarks/doctor/reports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/schema_errors.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/program_files.h"

namespace benchmarks::doctor {
namespace {

using scene::Json;

// ---- Kinds --------------------------------------------------------------------------------------

// Kinds of reports, as in the names of their schemas: "hairbench-report/1.5.0".
constexpr std::array kKinds{"report", "physics", "lod", "gate", "ablation", "doctor"};
constexpr const char* kRun = "report";

std::optional<std::string> kindOf(const Json& report) {
    if (!report.is_object()) return std::nullopt;
    const std::string schema = scene::textAt(report, "/schema");
    for (const char* kind : kKinds)
        if (schema.starts_with("hairbench-" + std::string(kind) + '/')) return kind;
    return std::nullopt;
}

// ---- A report's facts for the doctor ------------------------------------------------------------

// The checks that a report has facts for. A report has no governors and no power supply, and does
// not tell whether a repeated case is the same.
constexpr std::array kAsked{"build",  "layers",     "pass sum", "pass times",
                            "clocks", "other load", "steal"};

std::optional<double> numberIn(const Json& report, const char* pointer) {
    const Json::json_pointer place(pointer);
    if (!report.contains(place) || !report.at(place).is_number()) return std::nullopt;
    return report.at(place).get<double>();
}

Facts factsOfBuild(const Json& report) {
    Facts facts;
    facts.device.name = scene::textAt(report, "/environment/device/name");
    facts.device.type = scene::textAt(report, "/environment/device/type");
    facts.build.build.type = scene::textAt(report, "/environment/build/type");
    facts.build.build.flags = scene::textAt(report, "/environment/build/flags");
    facts.build.build.dirty = scene::textAt(report, "/environment/build/dirty") == "true";
    facts.layers.validation = scene::textAt(report, "/environment/validation") == "true";
    return facts;
}

// Since 1.3 there is a verdict on timestamps; before, there was only a sentence.
bool areTimestampsWrong(const Json& result) {
    if (scene::textAt(result, "/trust/timestamps") == "wrong") return true;
    const Json::json_pointer warnings("/trust/warnings");
    return result.contains(warnings) &&
           std::ranges::any_of(result.at(warnings), [](const Json& each) {
               return each.is_string() &&
                      each.get_ref<const std::string&>().starts_with("timestamps are not trusted");
           });
}

void addCaseFacts(Facts& facts, const Json& result) {
    facts.timestamps.valid_bits = 1;  // the checks only test whether there are any
    measure::PassSum& sum = facts.passes.sum;
    sum.over_wall = numberIn(result, "/trust/pass_sum_over_wall");
    sum.over_device = numberIn(result, "/trust/pass_sum_over_device");
    sum.incomplete = sum.over_device && std::abs(*sum.over_device - 1.0) > measure::kTrustTolerance;
    if (areTimestampsWrong(result))
        facts.passes.faults = {"timestamps differ from the CPU's clock"};
    facts.load.steal = numberIn(result, "/conditions/steal");
    facts.load.others = numberIn(result, "/conditions/other_load");
    if (const auto clock = numberIn(result, "/conditions/clock_mhz")) {
        ClockFacts& clocks = facts.clocks.emplace();
        clocks.held = true;  // unknown, and irrelevant to the report's times
        clocks.highest_mhz = clock;
        clocks.lowest_mhz = numberIn(result, "/conditions/lowest_clock_mhz");
        clocks.conditions.clock_mhz = clock;
        clocks.conditions.temperature = numberIn(result, "/conditions/temperature");
        for (const Json& each : result.at("conditions").value("throttle_reasons", Json::array()))
            clocks.conditions.throttle_reasons.push_back(each.get<std::string>());
    }
}

// ---- Judging ------------------------------------------------------------------------------------

// The worst judgement of one check over all facts, if it is at least a warning.
std::optional<Finding> worstOf(const DoctorCheck& check, const std::vector<Facts>& all) {
    std::optional<Finding> worst;
    std::size_t count = 0;
    for (const Facts& facts : all) {
        const Judgement judgement = check.judge(facts);
        if (judgement.health < Health::warn) continue;
        if (worst && judgement.health == worst->health) ++count;
        if (worst && judgement.health <= worst->health) continue;
        worst = {check.name, judgement.health, judgement.seen, judgement.advice};
        count = 1;
    }
    if (worst && all.size() > 1)
        worst->seen +=
            " (in " + std::to_string(count) + " of " + report::countText(all.size(), "case") + ')';
    return worst;
}

std::vector<Finding> judge(const std::vector<Facts>& all) {
    std::vector<Finding> findings;
    for (const DoctorCheck& check : doctorChecks()) {
        if (std::ranges::find(kAsked, std::string_view(check.name)) == kAsked.end()) continue;
        if (std::optional<Finding> worst = worstOf(check, all))
            findings.push_back(std::move(*worst));
    }
    return findings;
}

const Finding* findBad(const ReportExamination& examination) {
    const auto bad = std::ranges::find(examination.findings, Health::bad, &Finding::health);
    return bad == examination.findings.end() ? nullptr : &*bad;
}

}  // namespace

ReportExamination examineReport(const std::filesystem::path& file) {
    const std::string text = engine::readFile(file);
    Json report = scene::parseJson(text, file.string());
    const std::optional<std::string> kind = kindOf(report);
    if (!kind) throw engine::Error(file.string(), "is not a report of hairbench");
    ReportExamination examination{
        .schema = scene::textAt(report, "/schema"),
        .device = scene::textAt(report, "/environment/device/name"),
        .schema_errors = report::schemaErrors(
            engine::readFile(engine::programFile("results/" + *kind + ".schema.json")), text),
        .mark = scene::textAt(report, "/untrusted")};
    if (!examination.schema_errors.empty()) return examination;  // nothing else is reliable
    std::vector<Facts> all;
    if (*kind == kRun) {
        report = report::readReport(file);  // with the samples stored beside it
        examination.cases = report.at("cases").size();
        for (const Json& result : report.at("cases"))
            if (result.value("status", "") == "ok")
                addCaseFacts(all.emplace_back(factsOfBuild(report)), result);
    }
    if (all.empty()) all.push_back(factsOfBuild(report));
    if (report.contains(Json::json_pointer("/environment/build")))
        examination.findings = judge(all);
    return examination;
}

bool isAccepted(const ReportExamination& examination) {
    return examination.schema_errors.empty() &&
           (!findBad(examination) || !examination.mark.empty());
}

std::string examinationText(const ReportExamination& examination) {
    if (const auto& errors = examination.schema_errors; !errors.empty()) {
        // The deepest place: its parents are at fault only because of it.
        const auto depth = [](const std::string& error) { return error.find(": "); };
        return *std::ranges::max_element(errors, {}, depth) +
               (errors.size() > 1 ? " (" + report::countText(errors.size(), "fault") + ')' : "");
    }
    const Finding* const bad = findBad(examination);
    if (!isAccepted(examination))
        return bad->check + ": " + bad->seen +
               ": not to be trusted; measure again, or say why it is kept in a member "
               "\"untrusted\"";
    std::string text = "ok, ";
    text +=
        examination.cases > 0 ? report::countText(examination.cases, "case") : examination.schema;
    if (!examination.device.empty()) text += " on " + examination.device;
    if (!examination.mark.empty()) text += "; marked as not to be trusted: " + examination.mark;
    for (const Finding& each : examination.findings)
        if (each.health == Health::warn) text += "; " + each.check + ": " + each.seen;
    return text;
}

}  // namespace benchmarks::doctor
