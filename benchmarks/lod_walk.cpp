#include "benchmarks/lod_walk.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "benchmarks/interrupt.h"
#include "benchmarks/lod_difference.h"
#include "benchmarks/statistics.h"
#include "benchmarks/trust.h"
#include "hair/rendering/lod_levels.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kWarmUps = 2;  // frames of a pipeline before it is timed
constexpr std::uint32_t kRepeats = 5;  // timed frames of a step

hair::Settings atLevelZero(hair::Settings settings) {
    settings.lod.mode = hair::LodMode::forced;
    settings.lod.level = 0.0f;
    return settings;
}

// White hair alone on black, opaque, 16 samples a pixel: its mean is what the hair hides.
hair::Settings coverageOf(hair::Settings settings) {
    settings.shading = {
        .color = glm::vec3(1.0f), .ambient = 1.0f, .diffuse = 0.0f, .specular = 0.0f};
    settings.strands.opacity = 1.0f;
    settings.strands.texture.clear();
    settings.render = {
        .width = 256, .height = 256, .ssaa = 4, .background = glm::vec3(0.0f), .head = false};
    return settings;
}

// What is drawn of the frozen hair with one set of settings.
class View {
public:
    View(const engine::Device& device, const Case& hair, const hair::Settings& settings)
        : device_(device), view_(hair.view()), renderer_(hair.rendererOf(settings)),
          loop_(device, engine::Timing::isolated) {}

    void setCamera(const hair::CameraSettings& camera) { renderer_.setCamera(camera); }
    std::uint64_t strands() const { return renderer_.plan().strands(); }

    void draw() {
        checkInterrupted();
        loop_.frame([&](engine::Passes& passes) { renderer_.record(passes, view_); });
    }

    // Of the frames since the last call.
    LodTimes times() {
        const std::vector<engine::FrameRecord> frames = loop_.finish();
        std::vector<double> walls;
        for (const engine::FrameRecord& frame : frames) walls.push_back(frame.wall);
        return {
            .strands = summarize(passTimes(frames, "strands")).median,
            .frame = summarize(walls).median};
    }

    Picture picture() {
        loop_.finish();
        return engine::readOutput(device_, renderer_.target());
    }

private:
    const engine::Device& device_;
    hair::StrandView view_;
    hair::Renderer renderer_;
    engine::FrameLoop loop_;
};

// The camera zooms in so that the square is as large as what the hair can't leave: the measure does
// not get coarser with the distance.
hair::CameraSettings zoomedOn(const hair::StrandView& view, const hair::CameraSettings& camera) {
    hair::CameraSettings zoomed = camera;
    zoomed.target = glm::vec3(view.head * glm::vec4(view.centre, 1.0f));
    const float sine = view.radius / glm::distance(zoomed.position, zoomed.target);
    zoomed.field_of_view = std::min(2.0f * glm::degrees(std::asin(std::min(sine, 1.0f))), 120.0f);
    return zoomed;
}

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
    const engine::Device& device, Case& hair, const hair::Settings& settings, const LodPath& path,
    const std::function<void(double)>& begin, std::vector<LodStep>& steps) {
    hair::Settings by_distance = settings;
    by_distance.lod.mode = hair::LodMode::distance;
    View lod(device, hair, by_distance);
    View full(device, hair, atLevelZero(settings));
    View lod_cover(device, hair, coverageOf(by_distance));
    View full_cover(device, hair, coverageOf(atLevelZero(settings)));
    const std::vector<glm::vec3> guides = hair.guides();

    Picture before;
    Picture full_before;
    for (const double distance : distancesOf(path)) {
        begin(distance);
        const hair::CameraSettings camera = cameraAt(settings.camera, distance);
        by_distance.camera = camera;
        for (View* each : {&lod, &full}) each->setCamera(camera);
        for (View* each : {&lod_cover, &full_cover}) {
            each->setCamera(zoomedOn(hair.view(), camera));
            each->draw();
        }
        for (std::uint32_t i = 0; i < kWarmUps; ++i)
            for (View* each : {&lod, &full}) each->draw();
        lod.times();
        full.times();
        for (std::uint32_t i = 0; i < kRepeats; ++i)  // in turns: a disturbance meets both
            for (View* each : {&lod, &full}) each->draw();

        const hair::DistanceLod state =
            hair::distanceLod(hair.groom(), guides, hair.view(), by_distance);
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

}  // namespace benchmarks
