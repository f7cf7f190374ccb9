#include "benchmarks/doctor/report.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/report/text.h"

namespace benchmarks::doctor {
namespace {

// ---- JSON ---------------------------------------------------------------------------------------

scene::Json toJson(const Finding& finding) {
    scene::Json object = {
        {"check", finding.check}, {"verdict", healthName(finding.health)}, {"seen", finding.seen}};
    if (!finding.advice.empty()) object["advice"] = finding.advice;
    return object;
}

scene::Json toJson(const Sensitivity& each) {
    scene::Json object = {{"metric", each.metric.name()}};
    if (std::isfinite(each.decisive_change)) object["decisive_change"] = each.decisive_change;
    if (std::isfinite(each.smallest_slowdown)) object["smallest_slowdown"] = each.smallest_slowdown;
    return object;
}

scene::Json toJson(const PlantedGate& gate) {
    scene::Json object = {
        {"pass", gate.pass}, {"found", gate.found}, {"elsewhere", gate.elsewhere}};
    if (std::isfinite(gate.planted)) object["planted"] = gate.planted;
    return object;
}

template <class Thing>
scene::Json listOf(const std::vector<Thing>& things) {
    scene::Json list = scene::Json::array();
    for (const Thing& thing : things) list.push_back(toJson(thing));
    return list;
}

}  // namespace

Finding judgePlanted(const std::vector<PlantedGate>& gates) {
    const auto found = std::ranges::count(gates, true, &PlantedGate::found);
    const auto elsewhere = std::ranges::count(gates, true, &PlantedGate::elsewhere);
    const auto all = static_cast<std::ptrdiff_t>(gates.size());
    Finding finding{
        "planted slowdowns",
        Health::ok,
        std::to_string(found) + " of " + std::to_string(all) + " found in their pass, " +
            std::to_string(elsewhere) + " in another one too",
        {}};
    if (found == all && elsewhere == 0) return finding;
    finding.health = Health::bad;
    finding.advice = "gates on this machine miss slowdowns or name the wrong pass: fix the other "
                     "findings, and repeat";
    return finding;
}

bool isTrusted(const DoctorReport& report) {
    return std::ranges::find(report.findings, Health::bad, &Finding::health) ==
           report.findings.end();
}

std::string doctorReportText(const DoctorReport& report) {
    scene::Json object = scene::Json::object();
    object["schema"] = kDoctorSchema;
    object["environment"] = report::environmentJson(report.environment);
    object["trusted"] = isTrusted(report);
    object["interrupted"] = report.interrupted;
    object["findings"] = listOf(report.findings);
    if (!report.sensitivities.empty()) object["sensitivities"] = listOf(report.sensitivities);
    if (!report.planted.empty()) object["planted"] = listOf(report.planted);
    // Output of drivers and commands need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Text for a terminal ------------------------------------------------------------------------

std::string tableOf(const std::vector<report::Column>& columns, std::size_t rows) {
    std::string text;
    for (std::size_t row = 0; row <= rows; ++row) text += report::columnsLine(columns, row);
    return text;
}

std::string shareCell(double share) {
    return std::isfinite(share) ? report::shareText(share) : "-";
}

std::string findingsTable(const std::vector<Finding>& findings) {
    std::vector<report::Column> columns{{"check", false}, {"verdict", false}, {"seen", false}};
    for (const Finding& finding : findings) {
        columns[0].cells.push_back(finding.check);
        columns[1].cells.emplace_back(healthName(finding.health));
        columns[2].cells.push_back(finding.seen);
    }
    return tableOf(columns, findings.size());
}

std::string sensitivityTable(const std::vector<Sensitivity>& sensitivities) {
    std::vector<report::Column> columns{
        {"metric", false}, {"changes count from"}, {"48 pairs find"}};
    for (const Sensitivity& each : sensitivities) {
        columns[0].cells.push_back(each.metric.name());
        columns[1].cells.push_back(shareCell(each.decisive_change));
        columns[2].cells.push_back(shareCell(each.smallest_slowdown));
    }
    return tableOf(columns, sensitivities.size());
}

std::string plantedTable(const std::vector<PlantedGate>& gates) {
    std::vector<report::Column> columns{{"planted in", false}, {"slower by"}, {"found", false}};
    for (const PlantedGate& gate : gates) {
        columns[0].cells.push_back(gate.pass);
        columns[1].cells.push_back(shareCell(gate.planted));
        columns[2].cells.emplace_back(
            std::string(gate.found ? "yes" : "no") +
            (gate.elsewhere ? ", and in another pass" : ""));
    }
    return tableOf(columns, gates.size());
}

// Lists bad findings first.
std::string toFix(const std::vector<Finding>& findings) {
    std::string text;
    for (const Health health : {Health::bad, Health::warn, Health::unknown})
        for (const Finding& finding : findings)
            if (finding.health == health && !finding.advice.empty())
                text += "  " + finding.check + ": " + finding.advice + '\n';
    return text.empty() ? text : "\nwhat to fix:\n" + text;
}

std::string conclusion(const DoctorReport& report) {
    const auto bad = std::ranges::count(report.findings, Health::bad, &Finding::health);
    const auto warned = std::ranges::count(report.findings, Health::warn, &Finding::health);
    if (bad > 0)
        return "timings can't be trusted: " + std::to_string(bad) +
               (bad == 1 ? " check is bad\n" : " checks are bad\n");
    if (warned > 0)
        return "timings can be used with care: " + std::to_string(warned) +
               (warned == 1 ? " warning\n" : " warnings\n");
    return "timings can be trusted\n";
}

}  // namespace

std::string doctorText(const DoctorReport& report) {
    std::string text = findingsTable(report.findings);
    if (!report.sensitivities.empty())
        text += "\nslowdowns that a gate can find here:\n" + sensitivityTable(report.sensitivities);
    if (!report.planted.empty()) text += '\n' + plantedTable(report.planted);
    return text + toFix(report.findings) + '\n' + conclusion(report);
}

}  // namespace benchmarks::doctor
