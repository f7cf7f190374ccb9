#include "benchmarks/physics/report.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace benchmarks::physics {

namespace {

Json toJson(const Outcome& outcome) {
    Json object = {{"check", outcome.check}, {"solver", outcome.solver}};
    if (!outcome.quantity.name.empty()) {
        object["quantity"] = outcome.quantity.name;
        object["unit"] = outcome.quantity.unit;
        Json& parameters = object["parameters"] = Json::object();
        for (const Parameter& each : outcome.quantity.parameters)
            parameters[each.name] = {{"value", each.value}, {"unit", each.unit}};
    }
    if (std::isfinite(outcome.measured)) object["measured"] = outcome.measured;
    if (outcome.expected) object["expected"] = *outcome.expected;
    if (outcome.error) object["error"] = *outcome.error;
    if (outcome.tolerance && std::isfinite(*outcome.tolerance))
        object["tolerance"] = *outcome.tolerance;
    object["verdict"] = verdictName(outcome.verdict);
    if (!outcome.reason.empty()) object["reason"] = outcome.reason;
    if (!outcome.state_hash.empty()) object["state_hash"] = outcome.state_hash;
    return object;
}

Json toJson(const Curve& curve) {
    Json object = {{"check", curve.check}, {"solver", curve.solver}, {"name", curve.name}};
    Json& columns = object["columns"] = Json::array();
    for (const Series& each : curve.columns)
        columns.push_back({{"name", each.name}, {"unit", each.unit}});
    object["rows"] = curve.rows;
    return object;
}

}  // namespace

std::string physicsReportText(const PhysicsReport& report) {
    Json object = Json::object();
    object["schema"] = kPhysicsSchema;
    object["environment"] = environmentJson(report.environment);
    object["interrupted"] = report.interrupted;
    Json& outcomes = object["outcomes"] = Json::array();
    for (const Outcome& outcome : report.outcomes) outcomes.push_back(toJson(outcome));
    Json& curves = object["curves"] = Json::array();
    for (const Curve& curve : report.curves) curves.push_back(toJson(curve));
    // What drivers and commands say need not be UTF-8.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks::physics
