#include "benchmarks/report/methods.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>

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

}  // namespace

void Methods::Range::add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
}

std::string Methods::Range::text() const {
    const std::string text = shortNumber(least);
    return least == most ? text : text + " to " + shortNumber(most);
}

void Methods::add(const Json& result) {
    const std::string status = result.value("status", "");
    ++(status == "ok" ? measured_ : status == "skipped" ? skipped_ : failed_);
    if (status == "ok") {
        const std::string of_scene = textAt(header_, "/scene/document/run/clocks");
        const std::string clocks = result.at("axes").value("/run/clocks", of_scene);
        locked_ += clocks == "locked";
        free_ += clocks == "free";
        const std::string stamps = textAt(result, "/trust/timestamps");
        right_stamps_ += stamps == "right";
        wrong_stamps_ += stamps == "wrong";
    }
    std::optional<double> plays;
    for (const Json& mode : result.value("sampling", Json::array())) {
        warmup_rounds_ += mode.value("warmup_rounds", std::uint64_t{0});
        throttled_rounds_ += mode.value("throttled_rounds", std::uint64_t{0});
        if (mode.contains("plays"))
            plays = std::max(plays.value_or(0.0), mode["plays"].get<double>());
    }
    if (plays) plays_.add(*plays);
    if (const auto clock = numberAt(result, "/conditions/clock_mhz")) clocks_.add(*clock);
    if (const auto clock = numberAt(result, "/conditions/lowest_clock_mhz"))
        lowest_clocks_.add(*clock);
    if (const auto degrees = numberAt(result, "/conditions/temperature"))
        temperatures_.add(*degrees);
    const std::string energy_source = textAt(result, "/conditions/energy_source");
    counted_energies_ += energy_source == "counter";
    power_energies_ += energy_source == "power";
    if (const Json::json_pointer place("/trust/warnings");
        result.contains(place) && !result.at(place).empty())
        ++warned_;
}

std::string Methods::machineText() const {
    std::string text =
        "Times were taken with hairbench " + textAt(header_, "/environment/build/version");
    if (const std::string commit = textAt(header_, "/environment/build/commit"); !commit.empty())
        text += " (commit " + commit + ')';
    text += " on " + textAt(header_, "/environment/device/name");
    std::string driver = textAt(header_, "/environment/device/driver");
    if (const std::string version = textAt(header_, "/environment/device/driver_version");
        !version.empty())
        driver += (driver.empty() ? "" : " ") + version;
    if (!driver.empty()) text += " with driver " + driver;
    if (const std::string processor = textAt(header_, "/environment/host/processor");
        !processor.empty())
        text += ", host " + processor;
    if (const std::string system = textAt(header_, "/environment/host/system"); !system.empty())
        text += ", " + system;
    return text + ". ";
}

std::string Methods::casesText() const {
    std::string text = countText(measured_, "case") + " of scene " +
                       std::filesystem::path(textAt(header_, "/scene/path")).filename().string();
    text += measured_ == 1 ? " was measured" : " were measured";
    if (header_.contains("order_seed")) text += " in random order";
    if (skipped_ > 0)
        text += ", " + std::to_string(skipped_) + " skipped because the machine lacks something";
    if (failed_ > 0) text += ", " + std::to_string(failed_) + " failed";
    return text + ". ";
}

std::string Methods::roundsText() const {
    const auto run = [&](const char* member) {
        return numberAt(header_, ("/scene/document/run/" + std::string(member)).c_str());
    };
    std::string text;
    if (const auto warmup = run("warmup"), frames = run("frames"); warmup && frames)
        text += "Each mode (overlapped frames, isolated passes) played rounds of " +
                countText(static_cast<std::uint64_t>(*warmup), "frame") + " to warm up and " +
                countText(static_cast<std::uint64_t>(*frames), "measured frame") +
                ", all rounds the same frames";
    if (!text.empty() && !plays_.empty())
        text += ", " + plays_.text() +
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

std::string Methods::statisticText() const {
    std::string text = "Times are medians over all samples, with 95 % intervals by order "
                       "statistics for the effective number of independent samples. ";
    if (warmup_rounds_ > 0)
        text += countText(warmup_rounds_, "round") + " at the start of a mode " +
                (warmup_rounds_ == 1 ? "was" : "were") +
                " left out because times had not settled. ";
    if (throttled_rounds_ > 0)
        text += countText(throttled_rounds_, "round") +
                (throttled_rounds_ == 1 ? " was" : " were") +
                " left out because heat or power throttled the device. ";
    return text;
}

// Says what /run/clocks asked for in the measured cases.
std::string Methods::clocksChoiceText() const {
    std::string text;
    if (locked_ > 0)
        text += "The device's clocks were locked at a rate that its board sustains in " +
                countText(locked_, "case") + ". ";
    if (free_ > 0)
        text += "The device's clocks were free to change in " + countText(free_, "case") + ". ";
    return text;
}

std::string Methods::clocksText() const {
    if (clocks_.empty()) return "No clock of the device was known. ";
    std::string text =
        "Under load the device's shaders ran at " + clocks_.text() + " MHz (medians of cases)";
    if (!lowest_clocks_.empty())
        text += ", never below " + shortNumber(lowest_clocks_.least) + " MHz";
    if (!temperatures_.empty()) text += ", at " + temperatures_.text() + " degrees Celsius";
    return text + ". ";
}

std::string Methods::energyText() const {
    std::string text;
    if (counted_energies_ > 0)
        text += "Energies are by the device's energy counter over the rounds that count in " +
                countText(counted_energies_, "case") + ". ";
    if (power_energies_ > 0)
        text += "Energies are the device's power readings times the frame time in " +
                countText(power_energies_, "case") + ". ";
    return text;
}

std::string Methods::trustText() const {
    std::string text =
        "In each case all modes had to end with the same picture and the same guides";
    if (right_stamps_ > 0)
        text += ", and the passes' timestamps were checked against the host's clock";
    if (right_stamps_ > 0 && right_stamps_ < measured_)
        text += " in " + std::to_string(right_stamps_) + " of " + countText(measured_, "case");
    if (wrong_stamps_ > 0)
        text += "; timestamps were wrong in " + countText(wrong_stamps_, "case") +
                ", and the host's clock timed its passes";
    if (warned_ == 0) return text + ".";
    return text + "; " + countText(warned_, "case") + (warned_ == 1 ? " has" : " have") +
           " warnings in the report.";
}

std::string Methods::text() const {
    return machineText() + casesText() + roundsText() + clocksChoiceText() + clocksText() +
           energyText() + statisticText() + trustText();
}

std::string methodsText(const Json& report) {
    Methods methods(report);
    for (const Json& result : report.at("cases")) methods.add(result);
    return methods.text();
}

}  // namespace benchmarks::report
