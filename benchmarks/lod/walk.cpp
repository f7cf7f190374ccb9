#include "benchmarks/lod/walk.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/float_pictures.h"
#include "engine/process.h"
#include "hair/fields.h"
#include "hair/rendering/strand_plan.h"

namespace benchmarks::lod {
namespace {

// ---- Errors of a level --------------------------------------------------------------------------

Picture
pictureOf(const engine::Device& device, const measure::Case& hair, const hair::Settings& settings) {
    FrozenView view(device, hair, settings);
    view.draw();
    return view.picture();
}

LevelErrors levelErrors(
    const engine::Device& device, const measure::Case& hair, const hair::Settings& settings,
    float level) {
    const hair::Settings at_level = atLevel(settings, level);
    FrozenView view(device, hair, at_level);
    view.draw();
    FrozenView cover(device, hair, coverageOf(at_level));
    cover.setCamera(zoomedOn(hair.view(), settings.camera));
    cover.draw();
    LevelErrors errors{
        .level = double{level}, .strands = view.strands(), .coverage = whiteShare(cover.picture())};
    if (level > 0.0f)
        errors.popping = rootMeanSquare(
            view.picture(), pictureOf(device, hair, atLevel(settings, level - kLevelStep)));
    return errors;
}

LightErrors lightErrors(
    const engine::Device& device, const measure::Case& hair, const hair::Settings& lit,
    double angle, float level, const std::filesystem::path& truth,
    const std::filesystem::path& file) {
    FrozenView view(device, hair, atLevel(lit, level));
    view.draw();
    engine::writeExr(file, lit.render.width, lit.render.height, view.radiance());
    const reference::PictureErrors errors = reference::comparePictures(truth, file, {});
    return {
        .angle = angle,
        .flip = errors.flip,
        .rmse = errors.rmse,
        .light_ratio = errors.light_ratio};
}

}  // namespace

namespace {

glm::quat aboutUp(const hair::CameraSettings& camera, double degrees) {
    return glm::angleAxis(static_cast<float>(glm::radians(degrees)), glm::normalize(camera.up));
}

}  // namespace

hair::Settings litFrom(hair::Settings settings, double angle) {
    const hair::CameraSettings& camera = settings.camera;
    const glm::vec3 to_camera = glm::normalize(camera.position - camera.target);
    settings.shading.lights = {
        {.type = hair::LightType::directional, .direction = -(aboutUp(camera, angle) * to_camera)}};
    settings.render.background = glm::vec3(0.0f);
    settings.render.environment.clear();
    settings.render.tone_map = hair::ToneMap::srgb;
    settings.render.exposure = 0.0f;
    return settings;
}

std::vector<float> comparedLevels(const hair::LodSettings& lod) {
    std::vector<float> levels;
    for (float level = 0.0f; level < lod.maximum_level + 1.0f; level += 1.0f)
        levels.push_back(level);
    return levels;
}

void compareWithTruth(
    const engine::Device& device, const scene::Scene& scene, const measure::Case& hair,
    const hair::Settings& settings, const TruthOptions& options, measure::HairCache& cache,
    LodTruth& truth) {
    {
        const engine::HeldMessages held;
        truth.samples = options.samples;
    }
    for (const float level : comparedLevels(settings.lod)) {
        LevelErrors errors = levelErrors(device, hair, settings, level);
        errors.full_coverage = truth.levels.empty() ? errors.coverage : truth.levels[0].coverage;
        const engine::HeldMessages held;  // they write what is known
        truth.levels.push_back(std::move(errors));
    }
    const engine::ScratchFolder folder;
    const std::filesystem::path traced = folder.path() / "traced.exr";
    for (const double angle : kLightAngles) {
        const hair::Settings lit = litFrom(settings, angle);
        reference::exportMitsuba(
            device, scene, atLevel(lit, 0.0f), options.frame, folder.path(), cache);
        reference::traceMitsuba(folder.path(), options.samples, traced);
        for (LevelErrors& each : truth.levels) {
            LightErrors errors = lightErrors(
                device, hair, lit, angle, static_cast<float>(each.level), traced,
                folder.path() / "level.exr");
            const engine::HeldMessages held;
            each.lights.push_back(std::move(errors));
        }
    }
}

// ---- Report -------------------------------------------------------------------------------------

scene::Json truthJson(const LodTruth& truth) {
    scene::Json object = {{"samples", truth.samples}, {"levels", scene::Json::array()}};
    for (const LevelErrors& level : truth.levels) {
        scene::Json of_level = {
            {"level", level.level},
            {"strands", level.strands},
            {"coverage", level.coverage},
            {"full_coverage", level.full_coverage}};
        if (level.popping) of_level["popping"] = *level.popping;
        scene::Json& lights = of_level["lights"] = scene::Json::array();
        for (const LightErrors& light : level.lights) {
            scene::Json of_light = {
                {"angle", light.angle}, {"flip", light.flip}, {"rmse", light.rmse}};
            if (light.light_ratio) of_light["light_ratio"] = *light.light_ratio;
            lights.push_back(std::move(of_light));
        }
        object["levels"].push_back(std::move(of_level));
    }
    return object;
}

namespace {

std::string rounded(std::optional<double> number, const char* format) {
    if (!number) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, *number);
    return text;
}

}  // namespace

std::string truthTable(const LodTruth& truth) {
    std::vector<report::Column> columns{
        {"level"},      {"strands"}, {"coverage, %"}, {"popping, 1/1000"},
        {"light, deg"}, {"FLIP"},    {"RMSE"},        {"light / traced"}};
    std::size_t rows = 0;
    for (const LevelErrors& level : truth.levels) {
        const std::optional<double> popping =
            level.popping ? std::optional(1000.0 * *level.popping) : std::nullopt;
        for (const LightErrors& light : level.lights) {
            const std::array cells{
                rounded(level.level, "%g"),
                std::to_string(level.strands),
                rounded(100.0 * level.coverage, "%.2f"),
                rounded(popping, "%.2f"),
                rounded(light.angle, "%g"),
                rounded(light.flip, "%.4f"),
                rounded(light.rmse, "%.4f"),
                rounded(light.light_ratio, "%.3f")};
            for (std::size_t i = 0; i < columns.size(); ++i) columns[i].cells.push_back(cells[i]);
            ++rows;
        }
    }
    std::string text = "\nagainst level 0 path-traced with " + std::to_string(truth.samples) +
                       " samples per pixel:\n";
    for (std::size_t row = 0; row <= rows; ++row) text += report::columnsLine(columns, row);
    return text;
}

// ---- A view of one frame ------------------------------------------------------------------------

hair::Settings atLevel(hair::Settings settings, float level) {
    settings.lod.mode = hair::LodMode::forced;
    settings.lod.level = level;
    return settings;
}

hair::Settings coverageOf(hair::Settings settings) {
    settings.shading = {
        .color = glm::vec3(1.0f), .ambient = 1.0f, .diffuse = 0.0f, .specular = 0.0f};
    settings.strands.opacity = 1.0f;
    settings.strands.texture.clear();
    settings.render = {
        .width = 256, .height = 256, .ssaa = 4, .background = glm::vec3(0.0f), .head = false};
    return settings;
}

hair::CameraSettings
zoomedOn(const hair::rendering::StrandView& view, const hair::CameraSettings& camera) {
    hair::CameraSettings zoomed = camera;
    zoomed.target = glm::vec3(view.head * glm::vec4(view.centre, 1.0f));
    const float sine = view.radius / glm::distance(zoomed.position, zoomed.target);
    zoomed.field_of_view = std::min(2.0f * glm::degrees(std::asin(std::min(sine, 1.0f))), 120.0f);
    return zoomed;
}

FrozenView::FrozenView(
    const engine::Device& device, const measure::Case& hair, const hair::Settings& settings)
    : device_(device), view_(hair.view()), renderer_(hair.rendererOf(settings)),
      loop_(device, engine::Timing::isolated) {
    if (settings.copies.count > 1)
        throw engine::Error("/copies/count", "pictures are compared for one head");
}

void FrozenView::draw() {
    engine::checkInterrupted();
    loop_.frame([&](engine::Passes& passes) { renderer_.record(passes, view_); });
}

LodTimes FrozenView::times() {
    const std::vector<engine::FrameRecord> frames = loop_.finish();
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : frames) walls.push_back(frame.wall);
    return {
        .strands = report::summarize(measure::passTimes(frames, "strands")).median,
        .frame = report::summarize(walls).median};
}

hair::rendering::DistanceLod FrozenView::clusters() const {
    hair::rendering::DistanceLod state{.strands = 0};
    const std::vector<hair::gpu::ClusterLevel> levels = renderer_.clusterLevels(device_);
    for (const hair::gpu::ClusterLevel& level : levels) {
        state.mean_level +=
            std::log2(static_cast<double>(renderer_.plan().density) / level.strands) /
            static_cast<double>(levels.size());
        *state.strands += static_cast<std::uint64_t>(std::ceil(level.strands));
    }
    return state;
}

std::uint64_t FrozenView::clusterSegments() const {
    const hair::rendering::StrandPlan& plan = renderer_.plan();
    std::uint64_t segments = 0;
    for (const hair::gpu::ClusterLevel& level : renderer_.clusterLevels(device_))
        segments += static_cast<std::uint64_t>(std::ceil(level.strands)) * plan.segments *
                    hair::rendering::drawnPieces(
                        plan.tessellation, level.pieces / static_cast<float>(plan.tessellation))
                        .count;
    return segments;
}

Picture FrozenView::picture() {
    loop_.finish();
    return engine::readOutput(device_, renderer_.target());
}

std::vector<float> FrozenView::radiance() {
    loop_.finish();
    return engine::readRadiance(device_, renderer_.target());
}

// ---- Differences of pictures --------------------------------------------------------------------

namespace {

// Mean of term(difference(i)), i running over the colours of all pixels.
template <class Difference, class Term>
double meanOf(std::size_t bytes, Difference difference, Term term) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bytes; ++i) {
        if (i % 4 == 3) continue;  // alpha
        sum += term(difference(i) / 255.0);
    }
    return sum / (0.75 * static_cast<double>(bytes));
}

template <class Difference>
double rootMeanSquareOf(std::size_t bytes, Difference difference) {
    return std::sqrt(meanOf(bytes, difference, [](double d) { return d * d; }));
}

template <class Difference>
double meanMagnitudeOf(std::size_t bytes, Difference difference) {
    return meanOf(bytes, difference, [](double d) { return std::abs(d); });
}

double meanMagnitude(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    assert(a.size() == b.size());
    return meanMagnitudeOf(a.size(), [&](std::size_t i) { return int{a[i]} - int{b[i]}; });
}

// The change of pictures from a to b at a place, less that of the full ones.
auto excessChange(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b) {
    assert(a.size() == b.size() && a.size() == full_a.size() && a.size() == full_b.size());
    return
        [=](std::size_t i) { return (int{b[i]} - int{a[i]}) - (int{full_b[i]} - int{full_a[i]}); };
}

}  // namespace

double rootMeanSquare(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    assert(a.size() == b.size());
    return rootMeanSquareOf(a.size(), [&](std::size_t i) { return int{a[i]} - int{b[i]}; });
}

double popping(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b) {
    return rootMeanSquareOf(a.size(), excessChange(a, b, full_a, full_b));
}

double shimmerBetween(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b) {
    return meanMagnitudeOf(a.size(), excessChange(a, b, full_a, full_b));
}

double whiteShare(std::span<const std::uint8_t> picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); i += 4) sum += picture[i] / 255.0;
    return sum / (0.25 * static_cast<double>(picture.size()));
}

// ---- The walk -----------------------------------------------------------------------------------

namespace {

// ---- Totals and JSON ----------------------------------------------------------------------------

scene::Json toJson(const LodTimes& times) {
    return {{"strands", times.strands}, {"frame", times.frame}};
}

scene::Json toJson(const LodDrawn& drawn) {
    scene::Json object = {
        {"mean_level", drawn.mean_level},
        {"error", drawn.error},
        {"flip", drawn.flip},
        {"coverage", drawn.coverage},
        {"time", toJson(drawn.time)}};
    if (drawn.strands) object["strands"] = *drawn.strands;
    if (drawn.segments) object["segments"] = *drawn.segments;
    if (drawn.popping) object["popping"] = *drawn.popping;
    return object;
}

scene::Json toJson(const LodStep& step) {
    scene::Json object = toJson(step.drawn);
    object["distance"] = step.distance;
    object["full_strands"] = step.full_strands;
    object["full_segments"] = step.full_segments;
    object["full_coverage"] = step.full_coverage;
    object["full_time"] = toJson(step.full_time);
    if (step.clusters) object["clusters"] = toJson(*step.clusters);
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

const LodDrawn& drawnOf(const LodStep& step, LodKind kind) {
    return kind == LodKind::cluster ? step.clusters.value() : step.drawn;
}

double changeOfCoverage(const LodStep& step, LodKind kind) {
    return step.full_coverage > 0.0 ? drawnOf(step, kind).coverage / step.full_coverage - 1.0 : 0.0;
}

bool hasClusters(const std::vector<LodStep>& steps) {
    return !steps.empty() && steps.front().clusters;
}

}  // namespace

LodTotals totalsOf(const std::vector<LodStep>& steps, LodKind kind) {
    assert(!steps.empty());
    LodTotals totals;
    LodTimes time;
    LodTimes full;
    for (const LodStep& step : steps) {
        const LodDrawn& drawn = drawnOf(step, kind);
        if (drawn.popping)
            totals.worst_popping = std::max(totals.worst_popping.value_or(0.0), *drawn.popping);
        const double change = changeOfCoverage(step, kind);
        totals.mean_coverage_change += change / static_cast<double>(steps.size());
        if (std::abs(change) > std::abs(totals.worst_coverage_change))
            totals.worst_coverage_change = change;
        time.strands += drawn.time.strands;
        time.frame += drawn.time.frame;
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
    if (hasClusters(report.steps))
        object["cluster_totals"] = toJson(totalsOf(report.steps, LodKind::cluster));
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

std::string stepsTable(const std::vector<LodStep>& steps, LodKind kind) {
    std::vector<report::Column> all{
        {"distance, m"},  {"level"},           {"strands"},     {"segments, %"}, {"error, 1/1000"},
        {"FLIP, 1/1000"}, {"popping, 1/1000"}, {"coverage, %"}, {"change, %"},   {"strands, ms"},
        {"full, ms"},     {"frame, ms"},       {"full, ms"}};
    for (const LodStep& step : steps) {
        const LodDrawn& drawn = drawnOf(step, kind);
        const std::array cells{
            fixed(step.distance, "%.3f"),
            fixed(drawn.mean_level, "%.2f"),
            drawn.strands ? std::to_string(*drawn.strands) : "-",
            drawn.segments && step.full_segments > 0
                ? fixed(
                      100.0 * static_cast<double>(*drawn.segments) /
                          static_cast<double>(step.full_segments),
                      "%.1f")
                : "-",
            thousandths(drawn.error),
            thousandths(drawn.flip),
            thousandths(drawn.popping),
            fixed(100.0 * drawn.coverage, "%.2f"),
            percent(changeOfCoverage(step, kind)),
            report::shortNumber(drawn.time.strands),
            report::shortNumber(step.full_time.strands),
            report::shortNumber(drawn.time.frame),
            report::shortNumber(step.full_time.frame)};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    std::string text;
    for (std::size_t row = 0; row <= steps.size(); ++row) text += report::columnsLine(all, row);
    if (steps.empty()) return text;
    const LodTotals totals = totalsOf(steps, kind);
    return text + "\nworst popping: " + thousandths(totals.worst_popping) +
           " thousandths\ncoverage change: mean " + percent(totals.mean_coverage_change) +
           " %, worst " + percent(totals.worst_coverage_change) + " %\nspeed-up: strands " +
           report::shortNumber(totals.strands_speed_up) + ", frame " +
           report::shortNumber(totals.frame_speed_up) + '\n';
}

}  // namespace

std::string lodTable(const LodReport& report) {
    std::string text = stepsTable(report.steps, LodKind::distance);
    if (hasClusters(report.steps))
        text += "\nlevels by cluster:\n" + stepsTable(report.steps, LodKind::cluster);
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

namespace {

// Half of a pixel's height at a distance of 1 m, m.
double pixelSlope(const hair::CameraSettings& camera, const hair::RenderSettings& render) {
    return std::tan(glm::radians(double{camera.field_of_view}) / 2.0) / render.height;
}

// The hair with one choice of levels, and as the measure of coverage needs it.
class WalkedHair {
public:
    WalkedHair(
        const engine::Device& device, const measure::Case& hair, const hair::Settings& settings)
        : view_(device, hair, settings), cover_(device, hair, coverageOf(settings)) {}

    FrozenView& view() { return view_; }
    const LodTimes& times() const { return times_; }

    // Sets the camera and returns the coverage of the hair, from the same place with `zoomed`. The
    // error of levels by cluster is as long there as in the picture.
    double coverageFrom(
        const hair::Settings& settings, const hair::CameraSettings& camera,
        const hair::CameraSettings& zoomed) {
        view_.setCamera(camera);
        cover_.setCamera(zoomed);
        cover_.setLodError(static_cast<float>(
            double{settings.lod.error} * pixelSlope(camera, settings.render) /
            pixelSlope(zoomed, coverageOf(settings).render)));
        cover_.draw();
        return whiteShare(cover_.picture());
    }

    // Takes the times and the last picture of the frames since the last call. Keeps the picture
    // before.
    void take() {
        times_ = view_.times();
        before_ = std::move(picture_);
        picture_ = view_.picture();
    }

    LodDrawn comparedWith(const WalkedHair& full, const hair::RenderSettings& render) {
        LodDrawn drawn{
            .error = rootMeanSquare(picture_, full.picture_),
            .flip = reference::flipError(full.picture_, picture_, render.width, render.height),
            .time = times_};
        if (!before_.empty())
            drawn.popping = popping(before_, picture_, full.before_, full.picture_);
        return drawn;
    }

private:
    FrozenView view_;
    FrozenView cover_;
    LodTimes times_;
    Picture picture_;
    Picture before_;
};

hair::Settings withMode(hair::Settings settings, hair::LodMode mode) {
    settings.lod.mode = mode;
    return settings;
}

}  // namespace

void walk(
    const engine::Device& device, measure::Case& hair, const hair::Settings& settings,
    const LodPath& path, LodKind kind, const std::function<void(double)>& begin,
    std::vector<LodStep>& steps) {
    hair::Settings by_distance = withMode(settings, hair::LodMode::distance);
    WalkedHair lod(device, hair, by_distance);
    WalkedHair full(device, hair, atLevel(settings, 0.0f));
    std::optional<WalkedHair> clusters;
    if (kind == LodKind::cluster)
        clusters.emplace(device, hair, withMode(settings, hair::LodMode::cluster));
    std::vector<WalkedHair*> all{&lod, &full};
    if (clusters) all.push_back(&*clusters);
    const std::vector<glm::vec3> guides = hair.guides();

    for (const double distance : distancesOf(path)) {
        begin(distance);
        const hair::CameraSettings camera = cameraAt(settings.camera, distance);
        const hair::CameraSettings zoomed = zoomedOn(hair.view(), camera);
        by_distance.camera = camera;
        std::vector<double> coverages;
        for (WalkedHair* each : all)
            coverages.push_back(each->coverageFrom(settings, camera, zoomed));
        for (std::uint32_t i = 0; i < kWarmUps; ++i)
            for (WalkedHair* each : all) each->view().draw();
        for (WalkedHair* each : all) each->view().times();
        for (std::uint32_t i = 0; i < kRepeats; ++i)  // alternately: disturbances affect all
            for (WalkedHair* each : all) each->view().draw();
        for (WalkedHair* each : all) each->take();

        LodStep step{
            .distance = distance,
            .drawn = lod.comparedWith(full, settings.render),
            .full_strands = full.view().strands(),
            .full_segments = full.view().segments(),
            .full_coverage = coverages[1],
            .full_time = full.times()};
        const auto say = [&](LodDrawn& drawn, const hair::rendering::DistanceLod& state) {
            drawn.mean_level = state.mean_level;
            drawn.strands = state.strands;
        };
        step.drawn.coverage = coverages[0];
        say(step.drawn,
            hair::rendering::distanceLod(hair.groom(), guides, hair.view(), by_distance));
        if (clusters) {
            step.clusters = clusters->comparedWith(full, settings.render);
            step.clusters->coverage = coverages[2];
            say(*step.clusters, clusters->view().clusters());
            step.clusters->segments = clusters->view().clusterSegments();
        }
        const engine::HeldMessages held;
        steps.push_back(step);
    }
}

// ---- Walk round the hair ------------------------------------------------------------------------

hair::CameraSettings cameraTurned(const hair::CameraSettings& camera, double degrees) {
    hair::CameraSettings turned = camera;
    turned.position = camera.target + aboutUp(camera, degrees) * (camera.position - camera.target);
    return turned;
}

hair::Settings supersampled(hair::Settings settings) {
    settings.render.msaa = 4;
    settings.render.ssaa = 4;
    settings.render.coverage = hair::Coverage::sampled;
    if (settings.strands.opacity == 1.0f) settings.render.transparency = hair::Transparency::none;
    return settings;
}

namespace {

// Calls draw(index) with the hair seen from each view of the path.
void drawTurn(
    FrozenView& view, const hair::CameraSettings& camera, const TurnPath& path,
    const std::function<void(double)>& begin,
    const std::function<void(std::size_t, Picture)>& drawn) {
    for (std::uint32_t i = 0; i <= path.steps; ++i) {
        const double degrees = path.degrees * i / path.steps;
        begin(degrees);
        view.setCamera(cameraTurned(camera, degrees));
        view.draw();
        drawn(i, view.picture());
    }
}

}  // namespace

const std::vector<Picture>& TurnTruth::pictures(
    const engine::Device& device, const measure::Case& hair, const hair::Settings& settings,
    const TurnPath& path, const std::function<void(double)>& begin) {
    const hair::Settings wanted = supersampled(settings);
    if (settings_ && !hair::differ(*settings_, wanted)) return pictures_;
    settings_.reset();
    pictures_.clear();
    FrozenView view(device, hair, wanted);
    drawTurn(view, settings.camera, path, begin, [&](std::size_t, Picture picture) {
        pictures_.push_back(std::move(picture));
    });
    settings_ = wanted;
    return pictures_;
}

Shimmer shimmerOf(
    const engine::Device& device, const measure::Case& hair, const hair::Settings& settings,
    const TurnPath& path, std::span<const Picture> truth,
    const std::function<void(double)>& begin) {
    assert(truth.size() == path.steps + std::size_t{1});
    Shimmer sum;
    Picture before;
    FrozenView view(device, hair, settings);
    drawTurn(view, settings.camera, path, begin, [&](std::size_t i, Picture picture) {
        sum.error += meanMagnitude(picture, truth[i]) / (path.steps + 1);
        if (i > 0) {
            sum.shimmer += shimmerBetween(before, picture, truth[i - 1], truth[i]) / path.steps;
            sum.change += meanMagnitude(truth[i - 1], truth[i]) / path.steps;
        }
        before = std::move(picture);
    });
    return sum;
}

scene::Json shimmerJson(const std::vector<ShimmerCase>& cases) {
    scene::Json array = scene::Json::array();
    for (const ShimmerCase& each : cases) {
        scene::Json axes = scene::Json::object();
        for (const scene::AxisValue& axis : each.axes) axes[axis.pointer] = axis.value.json();
        array.push_back(
            {{"name", each.name},
             {"axes", axes},
             {"shimmer", each.figures.shimmer},
             {"change", each.figures.change},
             {"error", each.figures.error}});
    }
    return array;
}

std::string shimmerTable(const std::vector<ShimmerCase>& cases) {
    std::vector<report::Column> columns{
        {"case", false}, {"shimmer, 1/1000"}, {"change, 1/1000"}, {"error, 1/1000"}};
    for (const ShimmerCase& each : cases) {
        const std::array cells{
            engine::shownText(each.name), thousandths(each.figures.shimmer),
            thousandths(each.figures.change), thousandths(each.figures.error)};
        for (std::size_t i = 0; i < columns.size(); ++i) columns[i].cells.push_back(cells[i]);
    }
    return report::columnsText(columns);
}

}  // namespace benchmarks::lod
