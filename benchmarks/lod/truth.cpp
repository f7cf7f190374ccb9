#include "benchmarks/lod/truth.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "benchmarks/lod/frozen_view.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/text.h"
#include "engine/float_pictures.h"
#include "engine/process.h"

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

hair::Settings litFrom(hair::Settings settings, double angle) {
    const hair::CameraSettings& camera = settings.camera;
    const glm::vec3 to_camera = glm::normalize(camera.position - camera.target);
    const glm::quat turn =
        glm::angleAxis(static_cast<float>(glm::radians(angle)), glm::normalize(camera.up));
    settings.shading.lights = {
        {.type = hair::LightType::directional, .direction = -(turn * to_camera)}};
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
    truth.samples = options.samples;
    for (const float level : comparedLevels(settings.lod)) {
        LevelErrors errors = levelErrors(device, hair, settings, level);
        errors.full_coverage = truth.levels.empty() ? errors.coverage : truth.levels[0].coverage;
        truth.levels.push_back(std::move(errors));
    }
    const engine::ScratchFolder folder;
    const std::filesystem::path traced = folder.path() / "traced.exr";
    for (const double angle : kLightAngles) {
        const hair::Settings lit = litFrom(settings, angle);
        reference::exportMitsuba(
            device, scene, atLevel(lit, 0.0f), options.frame, folder.path(), cache);
        reference::traceMitsuba(folder.path(), options.samples, traced);
        for (LevelErrors& each : truth.levels)
            each.lights.push_back(lightErrors(
                device, hair, lit, angle, static_cast<float>(each.level), traced,
                folder.path() / "level.exr"));
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

}  // namespace benchmarks::lod
