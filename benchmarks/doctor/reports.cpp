#include "benchmarks/doctor/reports.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/schema_errors.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
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

// ---- Judging ------------------------------------------------------------------------------------

// In the order of the doctor's rows.
constexpr std::array kDoubtOrder{"build",  "layers",     "pass sum", "pass times", "repeatability",
                                 "clocks", "other load", "steal",    "drift",      "noise"};

// Finds the worst doubt of each check over all cases of a report that ran.
class WorstDoubts {
public:
    void add(std::vector<report::Doubt> doubts) {
        ++cases_;
        for (report::Doubt& doubt : doubts) {
            Worst& worst = worst_[doubt.check];
            if (worst.cases > 0 && doubt.level < worst.doubt.level) continue;
            if (doubt.level > worst.doubt.level) worst.cases = 0;
            if (worst.cases++ == 0 || doubt.size > worst.doubt.size) worst.doubt = std::move(doubt);
        }
    }

    std::vector<Finding> findings() const {
        std::vector<Finding> findings;
        for (const char* check : kDoubtOrder) {
            const auto found = worst_.find(check);
            if (found == worst_.end()) continue;
            const auto& [cases, doubt] = found->second;
            std::string seen = doubt.text;
            if (cases_ > 1)
                seen += " (in " + std::to_string(cases) + " of " +
                        report::countText(cases_, "case") + ')';
            findings.push_back(
                {.check = check, .health = healthOf(doubt.level), .seen = std::move(seen)});
        }
        return findings;
    }

private:
    struct Worst {
        std::size_t cases = 0;  // with a doubt of this level
        report::Doubt doubt;
    };
    std::map<std::string, Worst> worst_;
    std::size_t cases_ = 0;
};

// A build that nobody can make again says nothing against its times.
void addDirty(const Json& report, std::vector<Finding>& findings) {
    const bool known_bad = !findings.empty() && findings.front().check == kDoubtOrder.front();
    if (known_bad || scene::textAt(report, "/environment/build/dirty") != "true") return;
    findings.insert(
        findings.begin(), {.check = kDoubtOrder.front(),
                           .health = Health::warn,
                           .seen = "not as committed: nobody can build this again"});
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
    if (!report.contains("environment")) return examination;
    if (*kind == kRun) report = report::readReport(file);  // with the samples stored beside it
    const Json& environment = report.at("environment");
    WorstDoubts worst;
    bool any_ran = false;
    examination.corrections = scene::textAt(report, "/corrections");
    if (*kind == kRun) {
        examination.cases = report.at("cases").size();
        for (const Json& each : report.at("cases"))
            if (auto verdict = report::judgeCase(environment, each)) {
                worst.add(std::move(verdict->doubts));
                any_ran = true;
            }
        examination.verdicts = report::verdictsOf(report).counts();
    }
    if (!any_ran) worst.add(report::judgeEnvironment(environment));
    examination.findings = worst.findings();
    addDirty(report, examination.findings);
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
    if (!examination.verdicts.empty()) text += ": " + examination.verdicts;
    if (!examination.mark.empty()) text += "; marked as not to be trusted: " + examination.mark;
    for (const Finding& each : examination.findings)
        if (each.health == Health::warn) text += "; " + each.check + ": " + each.seen;
    if (!examination.corrections.empty()) text += "; corrected: " + examination.corrections;
    return text;
}

}  // namespace benchmarks::doctor
