#include "benchmarks/lod/walk.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <optional>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/report/text.h"
#include "hair/rendering/strand_plan.h"

namespace benchmarks::lod {
namespace {

// ---- Totals and JSON ----------------------------------------------------------------------------

scene::Json toJson(const LodTimes& times) {
    return {{"strands", times.strands}, {"frame", times.frame}};
}

scene::Json toJson(const LodStep& step) {
    scene::Json object = {{"distance", step.distance}, {"mean_level", step.mean_level}};
    if (step.strands) object["strands"] = *step.strands;
    object["full_strands"] = step.full_strands;
    object["error"] = step.error;
    if (step.popping) object["popping"] = *step.popping;
    object["coverage"] = step.coverage;
    object["full_coverage"] = step.full_coverage;
    object["time"] = toJson(step.time);
    object["full_time"] = toJson(step.full_time);
    return object;
}

scene::Json toJson(const LodTotals& totals) {
    scene::Json object = scene::Json::object();
    if (totals.worst_popping) object["worst_popping"] = *totals.worst_popping;
    object["mean_coverage_change"] = totals.mean_coverage_change;
    object["worst_coverage_change"] = totals.worst_coverage_change;
    object["strands_speed_up"] = totals.strands_speed_up;
    object["frame_speed_up"] = totals.frame_speed_up;
    return object;
}

}  // namespace

LodTotals totalsOf(const std::vector<LodStep>& steps) {
    assert(!steps.empty());
    LodTotals totals;
    LodTimes time;
    LodTimes full;
    for (const LodStep& step : steps) {
        if (step.popping)
            totals.worst_popping = std::max(totals.worst_popping.value_or(0.0), *step.popping);
        const double change =
            step.full_coverage > 0.0 ? step.coverage / step.full_coverage - 1.0 : 0.0;
        totals.mean_coverage_change += change / static_cast<double>(steps.size());
        if (std::abs(change) > std::abs(totals.worst_coverage_change))
            totals.worst_coverage_change = change;
        time.strands += step.time.strands;
        time.frame += step.time.frame;
        full.strands += step.full_time.strands;
        full.frame += step.full_time.frame;
    }
    totals.strands_speed_up = full.strands / time.strands;
    totals.frame_speed_up = full.frame / time.frame;
    return totals;
}

std::string lodReportText(const LodReport& report) {
    scene::Json object = scene::Json::object();
    object["schema"] = kLodSchema;
    object["environment"] = report::environmentJson(report.environment);
    object["scene"] = {
        {"path", report.scene.path},
        {"hash", report.scene.hash},
        {"document", report.scene.document.json()}};
    object["frame"] = report.frame;
    object["interrupted"] = report.interrupted;
    scene::Json& steps = object["steps"] = scene::Json::array();
    for (const LodStep& step : report.steps) steps.push_back(toJson(step));
    if (!report.steps.empty()) object["totals"] = toJson(totalsOf(report.steps));
    if (report.truth) object["reference"] = truthJson(*report.truth);
    // Output of drivers and commands need not be UTF-8.
    return object.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

namespace {

// ---- Table for a terminal -----------------------------------------------------------------------

std::string fixed(double number, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string percent(double ratio) { return fixed(100.0 * ratio, "%+.2f"); }

// Errors of pictures are small, so they are shown in thousandths of the range.
std::string thousandths(std::optional<double> value) {
    return value ? fixed(1000.0 * *value, "%.2f") : "-";
}

std::vector<report::Column> columns(const std::vector<LodStep>& steps) {
    std::vector<report::Column> all{{"distance, m"},   {"level"},           {"strands"},
                                    {"error, 1/1000"}, {"popping, 1/1000"}, {"coverage, %"},
                                    {"change, %"},     {"strands, ms"},     {"full, ms"},
                                    {"frame, ms"},     {"full, ms"}};
    for (const LodStep& step : steps) {
        const double change =
            step.full_coverage > 0.0 ? step.coverage / step.full_coverage - 1.0 : 0.0;
        const std::array cells{
            fixed(step.distance, "%.3f"),
            fixed(step.mean_level, "%.2f"),
            step.strands ? std::to_string(*step.strands) : "-",
            thousandths(step.error),
            thousandths(step.popping),
            fixed(100.0 * step.coverage, "%.2f"),
            percent(change),
            report::shortNumber(step.time.strands),
            report::shortNumber(step.full_time.strands),
            report::shortNumber(step.time.frame),
            report::shortNumber(step.full_time.frame)};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    return all;
}

}  // namespace

std::string lodTable(const LodReport& report) {
    const std::vector<report::Column> all = columns(report.steps);
    std::string text;
    for (std::size_t row = 0; row <= report.steps.size(); ++row)
        text += report::columnsLine(all, row);
    if (report.steps.empty()) return text;
    const LodTotals totals = totalsOf(report.steps);
    text += "\nworst popping: " + thousandths(totals.worst_popping) +
            " thousandths\ncoverage change: mean " + percent(totals.mean_coverage_change) +
            " %, worst " + percent(totals.worst_coverage_change) + " %\nspeed-up: strands " +
            report::shortNumber(totals.strands_speed_up) + ", frame " +
            report::shortNumber(totals.frame_speed_up) + '\n';
    if (report.truth) text += truthTable(*report.truth);
    return text;
}

namespace {

// ---- Walk along the camera path -----------------------------------------------------------------

constexpr std::uint32_t kWarmUps = 2;  // frames per pipeline before timing
constexpr std::uint32_t kRepeats = 5;  // timed frames per step

}  // namespace

std::vector<double> distancesOf(const LodPath& path) {
    std::vector<double> distances;
    for (std::uint32_t i = 0; i < path.steps; ++i) {
        const double part = path.steps > 1 ? static_cast<double>(i) / (path.steps - 1) : 0.0;
        distances.push_back(path.from * std::pow(path.to / path.from, part));
    }
    return distances;
}

hair::CameraSettings cameraAt(const hair::CameraSettings& camera, double distance) {
    hair::CameraSettings moved = camera;
    const glm::vec3 direction = glm::normalize(camera.position - camera.target);
    moved.position = camera.target + static_cast<float>(distance) * direction;
    return moved;
}

void walk(
    const engine::Device& device, measure::Case& hair, const hair::Settings& settings,
    const LodPath& path, const std::function<void(double)>& begin, std::vector<LodStep>& steps) {
    hair::Settings by_distance = settings;
    by_distance.lod.mode = hair::LodMode::distance;
    FrozenView lod(device, hair, by_distance);
    FrozenView full(device, hair, atLevel(settings, 0.0f));
    FrozenView lod_cover(device, hair, coverageOf(by_distance));
    FrozenView full_cover(device, hair, coverageOf(atLevel(settings, 0.0f)));
    const std::vector<glm::vec3> guides = hair.guides();

    Picture before;
    Picture full_before;
    for (const double distance : distancesOf(path)) {
        begin(distance);
        const hair::CameraSettings camera = cameraAt(settings.camera, distance);
        by_distance.camera = camera;
        for (FrozenView* each : {&lod, &full}) each->setCamera(camera);
        for (FrozenView* each : {&lod_cover, &full_cover}) {
            each->setCamera(zoomedOn(hair.view(), camera));
            each->draw();
        }
        for (std::uint32_t i = 0; i < kWarmUps; ++i)
            for (FrozenView* each : {&lod, &full}) each->draw();
        lod.times();
        full.times();
        for (std::uint32_t i = 0; i < kRepeats; ++i)  // alternately: disturbances affect both
            for (FrozenView* each : {&lod, &full}) each->draw();

        const hair::rendering::DistanceLod state =
            hair::rendering::distanceLod(hair.groom(), guides, hair.view(), by_distance);
        LodStep step{
            .distance = distance,
            .mean_level = state.mean_level,
            .strands = state.strands,
            .full_strands = full.strands(),
            .coverage = whiteShare(lod_cover.picture()),
            .full_coverage = whiteShare(full_cover.picture()),
            .time = lod.times(),
            .full_time = full.times()};
        Picture picture = lod.picture();
        Picture full_picture = full.picture();
        step.error = rootMeanSquare(picture, full_picture);
        if (!before.empty()) step.popping = popping(before, picture, full_before, full_picture);
        before = std::move(picture);
        full_before = std::move(full_picture);
        steps.push_back(step);
    }
}

}  // namespace benchmarks::lod
