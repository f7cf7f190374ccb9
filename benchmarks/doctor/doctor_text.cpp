#include <algorithm>
#include <cmath>

#include "benchmarks/columns.h"
#include "benchmarks/doctor/doctor_report.h"
#include "benchmarks/doctor/texts.h"

namespace benchmarks {

namespace {

std::string tableOf(const std::vector<Column>& columns, std::size_t rows) {
    std::string text;
    for (std::size_t row = 0; row <= rows; ++row) text += columnsLine(columns, row);
    return text;
}

std::string shareCell(double share) { return std::isfinite(share) ? shareText(share) : "-"; }

std::string findingsTable(const std::vector<Finding>& findings) {
    std::vector<Column> columns{{"check", false}, {"verdict", false}, {"seen", false}};
    for (const Finding& finding : findings) {
        columns[0].cells.push_back(finding.check);
        columns[1].cells.emplace_back(healthName(finding.health));
        columns[2].cells.push_back(finding.seen);
    }
    return tableOf(columns, findings.size());
}

std::string sensitivityTable(const std::vector<Sensitivity>& sensitivities) {
    std::vector<Column> columns{{"metric", false}, {"changes count from"}, {"48 pairs find"}};
    for (const Sensitivity& each : sensitivities) {
        columns[0].cells.push_back(each.metric.name());
        columns[1].cells.push_back(shareCell(each.decisive_change));
        columns[2].cells.push_back(shareCell(each.smallest_slowdown));
    }
    return tableOf(columns, sensitivities.size());
}

std::string plantedTable(const std::vector<PlantedGate>& gates) {
    std::vector<Column> columns{{"planted in", false}, {"slower by"}, {"found", false}};
    for (const PlantedGate& gate : gates) {
        columns[0].cells.push_back(gate.pass);
        columns[1].cells.push_back(shareCell(gate.planted));
        columns[2].cells.emplace_back(
            std::string(gate.found ? "yes" : "no") +
            (gate.elsewhere ? ", and in another pass" : ""));
    }
    return tableOf(columns, gates.size());
}

// The bad ones first.
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

}  // namespace benchmarks
