#include "benchmarks/doctor/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"

namespace benchmarks::doctor {
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
