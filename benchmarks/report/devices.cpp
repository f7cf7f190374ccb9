#include "benchmarks/report/devices.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/baseline.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"

namespace benchmarks::report {
namespace {

using Pointers = std::set<std::string>;

// Adds the axes of all cases.
void addAxes(Pointers& pointers, const scene::Json& report) {
    for (const scene::Json& each : report.at("cases"))
        for (const auto& [pointer, value] : each.at("axes").items()) pointers.insert(pointer);
}

// Returns a key of the case's settings: its suite member, and its value on each axis. If its sweep
// lacks an axis, the scene's value counts.
std::string
playedBy(const scene::Json& report, const scene::Json& result, const Pointers& pointers) {
    const auto name = result.at("name").get<std::string>();
    scene::Json played = {name.substr(0, name.find('/'))};
    for (const std::string& pointer : pointers) {
        const auto own = result.at("axes").find(pointer);
        const scene::Json::json_pointer place("/scene/document" + pointer);
        if (own != result.at("axes").end())
            played.push_back(*own);
        else
            played.push_back(report.contains(place) ? report.at(place) : scene::Json());
    }
    return played.dump(-1, ' ', false, scene::Json::error_handler_t::replace);
}

// Returns the median frame time of each case in ms, by the keys from playedBy().
std::map<std::string, double> frameTimes(const scene::Json& report, const Pointers& pointers) {
    const scene::Json::json_pointer place("/metrics/" + ofFrame(Measured::time).name() + "/median");
    std::map<std::string, double> times;
    for (const scene::Json& each : report.at("cases")) {
        if (!each.contains(place) || !each.at(place).is_number()) continue;
        const auto time = each.at(place).get<double>();
        if (time > 0.0) times.emplace(playedBy(report, each, pointers), time);
    }
    return times;
}

std::optional<TimeRatio> timeRatio(const scene::Json& report, const scene::Json& first) {
    Pointers pointers;
    addAxes(pointers, first);
    addAxes(pointers, report);
    const std::map<std::string, double> reference = frameTimes(first, pointers);
    TimeRatio ratio;
    double sum = 0.0;
    for (const auto& [played, time] : frameTimes(report, pointers)) {
        const auto other = reference.find(played);
        if (other == reference.end()) continue;
        const double each = time / other->second;
        ratio.least = ratio.cases == 0 ? each : std::min(ratio.least, each);
        ratio.greatest = std::max(ratio.greatest, each);
        sum += std::log(each);
        ++ratio.cases;
    }
    if (ratio.cases == 0) return std::nullopt;
    ratio.mean = std::exp(sum / static_cast<double>(ratio.cases));
    return ratio;
}

}  // namespace

std::vector<OnDevice> compareDevices(std::span<const scene::Json> reports) {
    std::map<std::string, std::size_t> first_of;  // scene -> report
    std::vector<OnDevice> devices;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const std::size_t first = first_of.emplace(sceneNameOf(reports[i]), i).first->second;
        OnDevice& device = devices.emplace_back();
        device.report = i;
        device.first = first;
        if (first == i) continue;
        try {
            device.ratio = timeRatio(reports[i], reports[first]);
        } catch (const scene::Json::exception& error) {
            throw engine::Error("the reports can't be compared", scene::jsonReason(error));
        }
        device.differences = environmentDifferences(reports[first], reports[i]);
    }
    return devices;
}

scene::Json devicesJson(const std::vector<OnDevice>& devices) {
    scene::Json json = scene::Json::array();
    for (const OnDevice& each : devices) {
        json.push_back(
            {{"report", each.report}, {"first", each.first}, {"differences", each.differences}});
        if (each.ratio)
            json.back()["ratio"] = {
                {"cases", each.ratio->cases},
                {"mean", each.ratio->mean},
                {"least", each.ratio->least},
                {"greatest", each.ratio->greatest}};
    }
    return json;
}

}  // namespace benchmarks::report
