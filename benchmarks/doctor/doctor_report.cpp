#include "benchmarks/doctor/doctor_report.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace benchmarks {

namespace {

Json toJson(const Finding& finding) {
    Json object = {
        {"check", finding.check}, {"verdict", healthName(finding.health)}, {"seen", finding.seen}};
    if (!finding.advice.empty()) object["advice"] = finding.advice;
    return object;
}

Json toJson(const Sensitivity& each) {
    Json object = {{"metric", each.metric.name()}};
    if (std::isfinite(each.decisive_change)) object["decisive_change"] = each.decisive_change;
    if (std::isfinite(each.smallest_slowdown)) object["smallest_slowdown"] = each.smallest_slowdown;
    return object;
}

Json toJson(const PlantedGate& gate) {
    Json object = {{"pass", gate.pass}, {"found", gate.found}, {"elsewhere", gate.elsewhere}};
    if (std::isfinite(gate.planted)) object["planted"] = gate.planted;
    return object;
}

template <class Thing>
Json listOf(const std::vector<Thing>& things) {
    Json list = Json::array();
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
    finding.advice = "gates of this machine miss slowdowns or name the wrong pass: mend the rest "
                     "of this list, and repeat";
    return finding;
}

bool isTrusted(const DoctorReport& report) {
    return std::ranges::find(report.findings, Health::bad, &Finding::health) ==
           report.findings.end();
}

std::string doctorReportText(const DoctorReport& report) {
    Json object = Json::object();
    object["schema"] = kDoctorSchema;
    object["environment"] = environmentJson(report.environment);
    object["trusted"] = isTrusted(report);
    object["interrupted"] = report.interrupted;
    object["findings"] = listOf(report.findings);
    if (!report.sensitivities.empty()) object["sensitivities"] = listOf(report.sensitivities);
    if (!report.planted.empty()) object["planted"] = listOf(report.planted);
    // What drivers and commands say need not be UTF-8.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks
