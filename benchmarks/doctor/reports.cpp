#include "benchmarks/doctor/reports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "benchmarks/report/report.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::report {
namespace {

// valijson's tokens are <root>, [name] and [number]. Some releases put names in quotes.
std::string pointerOf(const std::vector<std::string>& context) {
    std::string pointer;
    for (std::string_view token : context) {
        if (!token.starts_with('[')) continue;
        token = token.substr(1, token.size() - 2);
        if (token.starts_with('"')) token = token.substr(1, token.size() - 2);
        pointer.append("/").append(token);
    }
    return pointer;
}

}  // namespace

std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document) {
    using Adapter = valijson::adapters::NlohmannJsonAdapter;
    const auto schema_json = nlohmann::json::parse(schema);
    const auto document_json = nlohmann::json::parse(document);
    valijson::Schema compiled;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(Adapter(schema_json), compiled);
    valijson::ValidationResults results;
    valijson::Validator().validate(compiled, Adapter(document_json), &results);
    std::vector<std::string> errors;
    for (valijson::ValidationResults::Error error; results.popError(error);)
        errors.push_back(pointerOf(error.context) + ": " + error.description);
    return errors;
}

}  // namespace benchmarks::report

// ---- Reports to keep ----------------------------------------------------------------------------

namespace benchmarks::doctor {

// ---- Reports to keep ----------------------------------------------------------------------------

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

// ---- Rules for reports --------------------------------------------------------------------------

namespace {

using report::countText;
using scene::Json;

// A report, with queries that several rules need.
class Judged {
public:
    explicit Judged(const Json& report) : report_(report) {
        for (const Json& result : report.at("cases")) {
            const std::string status = result.value("status", "");
            if (status == "ok")
                measured_.push_back(&result);
            else if (result.value("reason", "").empty())
                ++unexplained_;
        }
    }

    const Json& report() const { return report_; }
    const std::vector<const Json*>& measured() const { return measured_; }
    std::size_t all() const { return report_.at("cases").size(); }
    std::size_t unexplained() const { return unexplained_; }

    std::string text(const char* pointer) const {
        const Json::json_pointer place(pointer);
        return report_.contains(place) && report_.at(place).is_string()
                   ? report_.at(place).get<std::string>()
                   : std::string();
    }

    // True if the command that made the report has one of these options.
    bool hasOption(std::initializer_list<const char*> options) const {
        const Json command = report_.at("environment").value("command", Json::array());
        return std::ranges::any_of(command, [&](const Json& word) {
            return word.is_string() && std::ranges::any_of(options, [&](const char* option) {
                       const auto text = word.get<std::string>();
                       return text == option || text.starts_with(std::string(option) + '=');
                   });
        });
    }

    // Number of times of measured cases with more than one sample, and the number of these that
    // `lack`.
    std::pair<std::size_t, std::size_t>
    sampledTimes(const std::function<bool(const Json& metric)>& lack) const {
        std::size_t all = 0, lacking = 0;
        for (const Json* result : measured_)
            for (const auto& [name, metric] : result->at("metrics").items()) {
                if (metric.value("unit", "") != "ms" || metric.value("mode", "").empty()) continue;
                if (metric.value("samples", Json::array()).size() < 2) continue;
                ++all;
                if (lack(metric)) ++lacking;
            }
        return {all, lacking};
    }

private:
    const Json& report_;
    std::vector<const Json*> measured_;
    std::size_t unexplained_ = 0;
};

RuleFinding met(std::string seen) { return {{}, RuleVerdict::met, std::move(seen)}; }
RuleFinding notMet(std::string seen) { return {{}, RuleVerdict::not_met, std::move(seen)}; }
RuleFinding author(std::string seen) { return {{}, RuleVerdict::author, std::move(seen)}; }

RuleFinding absoluteTimes(const Judged& judged) {
    for (const Json* result : judged.measured())
        if (!result->at("metrics").contains("frame.time"))
            return notMet(result->at("name").get<std::string>() + " has no frame time");
    return met(
        "times of " + countText(judged.measured().size(), "case") +
        " in ms, no speedups: name the case that a speedup is taken over");
}

RuleFinding subsets(const Judged& judged) {
    if (judged.report().value("interrupted", false))
        return notMet("the run was interrupted: --resume measures the rest");
    if (judged.unexplained() > 0)
        return notMet(countText(judged.unexplained(), "case") + " without times give no reason");
    if (judged.hasOption({"--filter", "--shard"}))
        return author("only a part of the scene's cases was run (--filter, --shard): say why");
    return met(
        std::to_string(judged.measured().size()) + " of " + countText(judged.all(), "case") +
        " measured, the others with their reasons");
}

// Frames over their total time is the harmonic mean of their rates.
RuleFinding means(const Judged& judged) {
    for (const Json* result : judged.measured()) {
        const Json& metrics = result->at("metrics");
        if (!metrics.contains("fps") || !metrics.contains("frame.time")) continue;
        const double rate = metrics.at("fps").at("mean").get<double>();
        const double cost = metrics.at("frame.time").at("mean").get<double>();
        constexpr double kRounding = 1e-6;  // of sums of doubles that are written as decimals
        if (!(std::abs(rate * cost / 1e3 - 1.0) <= kRounding))
            return notMet(
                "fps of " + result->at("name").get<std::string>() +
                " is not the number of frames over their time");
    }
    return met("fps is frames over the time that they took, a harmonic mean; means are of times");
}

RuleFinding ratios(const Judged&) {
    return met(
        "no ratio is summarised; compare and gate give those of two medians with both times");
}

RuleFinding intervals(const Judged& judged) {
    const auto [all, lacking] =
        judged.sampledTimes([](const Json& metric) { return !metric.contains("interval"); });
    if (all == 0) return notMet("no time was sampled more than once");
    if (lacking > 0)
        return notMet(
            countText(lacking) + " of " + countText(all, "time") +
            " have too few samples for an interval: raise --max-time");
    std::size_t hashed = 0;
    for (const Json* result : judged.measured())
        if (result->contains("image_hash") && result->contains("state_hash")) ++hashed;
    return met(
        "95 % intervals of " + countText(all, "time") + "; pictures and guides of " +
        countText(hashed, "case") + " are deterministic, by their hashes");
}

RuleFinding normality(const Judged& judged) {
    const auto [all, lacking] = judged.sampledTimes([](const Json& metric) {
        return metric.contains("interval") && !metric.contains("effective_samples");
    });
    if (lacking > 0)
        return notMet(
            "the dependence of the samples of " + countText(lacking, "time") + " is not known");
    return met("order statistics, which assume no distribution; successive frames count by their "
               "dependence");
}

RuleFinding comparison(const Judged&) {
    return author("one report compares nothing: use 'hairbench gate' or 'hairbench compare', which "
                  "say what can't be decided");
}

RuleFinding percentiles(const Judged& judged) {
    const auto [all, lacking] = judged.sampledTimes([](const Json& metric) {
        return !metric.contains("percentile_5") || !metric.contains("percentile_95") ||
               !metric.contains("percentile_99");
    });
    if (all == 0) return notMet("no time was sampled more than once");
    if (lacking > 0) return notMet(countText(lacking, "time") + " have no percentiles");
    return met("medians with the 5th, 95th and 99th percentile, all samples and the 1 % lows");
}

RuleFinding setup(const Judged& judged) {
    constexpr std::array kNeeded{
        "/environment/device/name",
        "/environment/device/driver_version",
        "/environment/host/processor",
        "/environment/host/system",
        "/environment/build/version",
        "/environment/build/commit",
        "/environment/build/compiler",
        "/environment/build/type",
        "/scene/hash"};
    std::string missing;
    for (const char* pointer : kNeeded)
        if (judged.text(pointer).empty())
            missing += (missing.empty() ? "" : ", ") + std::string(pointer);
    if (!judged.report().contains("/scene/document"_json_pointer))
        missing += (missing.empty() ? "" : ", ") + std::string("/scene/document");
    if (!missing.empty()) return notMet("unknown: " + missing);
    if (judged.text("/environment/build/commit").ends_with("dirty") ||
        judged.report().value("/environment/build/dirty"_json_pointer, false))
        return notMet("built from files that differ from their commit");
    return met("every parameter, seed, device, driver, host, compiler and commit");
}

RuleFinding synchronisation(const Judged& judged) {
    for (const Json* result : judged.measured())
        if (result->value("sampling", Json::array()).empty())
            return notMet(
                "the sampling of " + result->at("name").get<std::string>() + " is not known");
    if (judged.text("/methods").empty())
        return notMet("no paragraph on methods: an older hairbench wrote the report");
    return met("modes, frames in flight, rounds and warm-up of each case; the paragraph 'methods'");
}

RuleFinding bounds(const Judged& judged) {
    for (const Json* result : judged.measured())
        if (result->contains("roofline")) return met("the roofline of the stages that were used");
    return author("no bound of the device is in the report: name its bandwidth or arithmetic rate, "
                  "or the share that the frame could reach");
}

RuleFinding plots(const Judged&) {
    return author("hairbench report plots medians with their intervals and all samples, and joins "
                  "points by lines along numbers only: do so in print, too");
}

struct Rule {
    const char* name;
    RuleFinding (*judge)(const Judged& judged);
};

constexpr std::array kRules{
    Rule{"speedups with their base case, and absolute times", absoluteTimes},
    Rule{"reasons for subsets", subsets},
    Rule{"means: arithmetic of costs, harmonic of rates", means},
    Rule{"no summary of ratios", ratios},
    Rule{"deterministic, or intervals", intervals},
    Rule{"normality not assumed", normality},
    Rule{"comparisons that are statistically sound", comparison},
    Rule{"percentiles where a median is not enough", percentiles},
    Rule{"the whole set-up", setup},
    Rule{"synchronisation and summary of parallel times", synchronisation},
    Rule{"upper bounds of performance", bounds},
    Rule{"plots that show their data", plots}};

}  // namespace

const char* ruleVerdictName(RuleVerdict verdict) {
    switch (verdict) {
    case RuleVerdict::met:
        return "met";
    case RuleVerdict::not_met:
        return "not met";
    case RuleVerdict::author:
        break;
    }
    return "author";
}

std::vector<RuleFinding> judgeRules(const scene::Json& report) try {
    const Judged judged(report);
    std::vector<RuleFinding> findings;
    for (const Rule& rule : kRules) {
        findings.push_back(rule.judge(judged));
        findings.back().rule = rule.name;
    }
    return findings;
} catch (const Json::exception& error) {
    throw engine::Error("the report can't be judged", scene::jsonReason(error));
}

bool meetsRules(const std::vector<RuleFinding>& findings) {
    return std::ranges::find(findings, RuleVerdict::not_met, &RuleFinding::verdict) ==
           findings.end();
}

std::string rulesText(const std::vector<RuleFinding>& findings) {
    std::vector<report::Column> columns{
        {"#"}, {"rule", false}, {"verdict", false}, {"seen", false}};
    for (const RuleFinding& finding : findings) {
        columns[0].cells.push_back(std::to_string(columns[0].cells.size() + 1));
        columns[1].cells.push_back(finding.rule);
        columns[2].cells.emplace_back(ruleVerdictName(finding.verdict));
        columns[3].cells.push_back(finding.seen);
    }
    std::string text;
    for (std::size_t row = 0; row <= findings.size(); ++row)
        text += report::columnsLine(columns, row);
    const auto count = [&](RuleVerdict verdict) {
        return std::to_string(std::ranges::count(findings, verdict, &RuleFinding::verdict));
    };
    return text + '\n' + count(RuleVerdict::met) + " of " + std::to_string(findings.size()) +
           " rules are met by the report, " + count(RuleVerdict::not_met) + " are not, " +
           count(RuleVerdict::author) + " are for the author\n";
}

}  // namespace benchmarks::doctor
