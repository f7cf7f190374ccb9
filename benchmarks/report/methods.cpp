#include "benchmarks/report/methods.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"

namespace benchmarks::report {
namespace {

using scene::Json;

std::string textAt(const Json& object, const char* pointer) {
    const Json::json_pointer place(pointer);
    return object.contains(place) && object.at(place).is_string()
               ? object.at(place).get<std::string>()
               : std::string();
}

std::optional<double> numberAt(const Json& object, const char* pointer) {
    const Json::json_pointer place(pointer);
    if (!object.contains(place) || !object.at(place).is_number()) return std::nullopt;
    return object.at(place).get<double>();
}

// Of the cases that were measured.
std::vector<double> valuesOf(
    const Json& report, const std::function<std::optional<double>(const Json& result)>& value) {
    std::vector<double> values;
    for (const Json& result : report.at("cases"))
        if (const auto each = value(result)) values.push_back(*each);
    return values;
}

std::uint64_t sumOfSampling(const Json& report, const char* member) {
    std::uint64_t sum = 0;
    for (const Json& result : report.at("cases"))
        for (const Json& mode : result.value("sampling", Json::array()))
            sum += mode.value(member, std::uint64_t{0});
    return sum;
}

// "3" or "3 to 17".
std::string rangeText(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    const std::string text = shortNumber(least);
    return least == most ? text : text + " to " + shortNumber(most);
}

std::string machineText(const Json& report) {
    std::string text =
        "Times were taken with hairbench " + textAt(report, "/environment/build/version");
    if (const std::string commit = textAt(report, "/environment/build/commit"); !commit.empty())
        text += " (commit " + commit + ')';
    text += " on " + textAt(report, "/environment/device/name");
    std::string driver = textAt(report, "/environment/device/driver");
    if (const std::string version = textAt(report, "/environment/device/driver_version");
        !version.empty())
        driver += (driver.empty() ? "" : " ") + version;
    if (!driver.empty()) text += " with driver " + driver;
    if (const std::string processor = textAt(report, "/environment/host/processor");
        !processor.empty())
        text += ", host " + processor;
    if (const std::string system = textAt(report, "/environment/host/system"); !system.empty())
        text += ", " + system;
    return text + ". ";
}

std::string casesText(const Json& report) {
    std::uint64_t measured = 0, failed = 0, skipped = 0;
    for (const Json& result : report.at("cases")) {
        const std::string status = result.value("status", "");
        ++(status == "ok" ? measured : status == "skipped" ? skipped : failed);
    }
    std::string text = countText(measured, "case") + " of scene " +
                       std::filesystem::path(textAt(report, "/scene/path")).filename().string();
    text += measured == 1 ? " was measured" : " were measured";
    if (report.contains("order_seed")) text += " in random order";
    if (skipped > 0) text += ", " + std::to_string(skipped) + " skipped for what the device lacks";
    if (failed > 0) text += ", " + std::to_string(failed) + " failed";
    return text + ". ";
}

std::string roundsText(const Json& report) {
    const auto run = [&](const char* member) {
        return numberAt(report, ("/scene/document/run/" + std::string(member)).c_str());
    };
    std::string text;
    if (const auto warmup = run("warmup"), frames = run("frames"); warmup && frames)
        text += "Each mode (overlapped frames, isolated passes) played rounds of " +
                countText(static_cast<std::uint64_t>(*warmup), "frame") + " to warm up and " +
                countText(static_cast<std::uint64_t>(*frames), "measured frame") +
                ", all rounds the same frames";
    const std::vector<double> plays = valuesOf(report, [](const Json& result) {
        std::optional<double> most;
        for (const Json& mode : result.value("sampling", Json::array()))
            if (mode.contains("plays"))
                most = std::max(most.value_or(0.0), mode["plays"].get<double>());
        return most;
    });
    if (!text.empty() && !plays.empty())
        text += ", " + rangeText(plays) +
                " times without a pause, after the device's clock had been "
                "driven up by at least " +
                shortNumber(run("warmup_time").value_or(0.0)) + " s of load";
    if (const auto precision = run("precision"), most = run("max_time");
        !text.empty() && precision && most)
        text += ", until half the 95 % interval of the median frame time was below " +
                shortNumber(*precision * 100.0) +
                " % of it and the last frames showed no trend, or " + shortNumber(*most) +
                " s had passed";
    if (!text.empty()) text += ". ";
    return text;
}

std::string statisticText(const Json& report) {
    std::string text =
        "Times are medians over all samples, with 95 % intervals by order statistics for as many "
        "independent samples as the dependent ones are worth. ";
    if (const std::uint64_t rounds = sumOfSampling(report, "warmup_rounds"); rounds > 0)
        text += countText(rounds, "round") + " at the start of a mode " +
                (rounds == 1 ? "was" : "were") + " left out as times still settled. ";
    if (const std::uint64_t rounds = sumOfSampling(report, "throttled_rounds"); rounds > 0)
        text += countText(rounds, "round") + (rounds == 1 ? " was" : " were") +
                " left out as heat or power held the device back. ";
    return text;
}

// What /run/clocks asked for in the cases that were measured.
std::string clocksChoiceText(const Json& report) {
    const std::string of_scene = textAt(report, "/scene/document/run/clocks");
    std::uint64_t locked = 0, free = 0;
    for (const Json& result : report.at("cases")) {
        if (result.value("status", "") != "ok") continue;
        const std::string clocks = result.at("axes").value("/run/clocks", of_scene);
        locked += clocks == "locked";
        free += clocks == "free";
    }
    std::string text;
    if (locked > 0)
        text += "The device's clocks were locked at what its board sustains in " +
                countText(locked, "case") + ". ";
    if (free > 0)
        text += "The device's clocks were free to change in " + countText(free, "case") + ". ";
    return text;
}

std::string clocksText(const Json& report) {
    const auto condition = [&](const char* member) {
        return valuesOf(report, [&](const Json& result) {
            return numberAt(result, ("/conditions/" + std::string(member)).c_str());
        });
    };
    const std::vector<double> clocks = condition("clock_mhz");
    if (clocks.empty()) return "No clock of the device was known. ";
    std::string text =
        "Under load the device's shaders ran at " + rangeText(clocks) + " MHz (medians of cases)";
    if (const std::vector<double> lowest = condition("lowest_clock_mhz"); !lowest.empty())
        text += ", never below " + shortNumber(std::ranges::min(lowest)) + " MHz";
    if (const std::vector<double> degrees = condition("temperature"); !degrees.empty())
        text += ", at " + rangeText(degrees) + " degrees Celsius";
    return text + ". ";
}

std::string trustText(const Json& report) {
    std::uint64_t warned = 0;
    for (const Json& result : report.at("cases"))
        if (const Json::json_pointer place("/trust/warnings");
            result.contains(place) && !result.at(place).empty())
            ++warned;
    std::string text =
        "In each case all modes had to end with the same picture and the same guides, and the "
        "passes' timestamps were held against the host's clock";
    if (warned == 0) return text + ".";
    return text + "; " + countText(warned, "case") + (warned == 1 ? " has" : " have") +
           " warnings in the report.";
}

}  // namespace

std::string methodsText(const scene::Json& report) {
    return machineText(report) + casesText(report) + roundsText(report) + clocksChoiceText(report) +
           clocksText(report) + statisticText(report) + trustText(report);
}

}  // namespace benchmarks::report
