#include "benchmarks/lod/frozen_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "benchmarks/measure/trust.h"
#include "benchmarks/report/statistics.h"
#include "engine/process.h"

namespace benchmarks::lod {

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
      loop_(device, engine::Timing::isolated) {}

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

// Root mean square of difference(i), i running over the colours of all pixels.
template <class Difference>
double rootMeanSquareOf(std::size_t bytes, Difference difference) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bytes; ++i) {
        if (i % 4 == 3) continue;  // alpha
        const double d = difference(i) / 255.0;
        sum += d * d;
    }
    return std::sqrt(sum / (0.75 * static_cast<double>(bytes)));
}

}  // namespace

double rootMeanSquare(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    assert(a.size() == b.size());
    return rootMeanSquareOf(a.size(), [&](std::size_t i) { return int{a[i]} - int{b[i]}; });
}

double popping(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b) {
    assert(a.size() == b.size() && a.size() == full_a.size() && a.size() == full_b.size());
    return rootMeanSquareOf(a.size(), [&](std::size_t i) {
        return (int{b[i]} - int{a[i]}) - (int{full_b[i]} - int{full_a[i]});
    });
}

double whiteShare(std::span<const std::uint8_t> picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); i += 4) sum += picture[i] / 255.0;
    return sum / (0.25 * static_cast<double>(picture.size()));
}

}  // namespace benchmarks::lod
