#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report.h"
#include "engine/device.h"
#include "hair/settings.h"

namespace benchmarks {

// Where what the viewer shows came from.
struct ReportOrigin {
    std::filesystem::path scene;
    std::string name;                  // of the scene
    std::vector<std::string> command;  // line that the viewer was started with
    engine::Validation validation = engine::Validation::off;
};

// The report of one case, as the runner's of a scene that has these settings and no sweep.
Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    CaseResult result);

// results/local/<scene>-<kind>.json
std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind);

// Writes it, with the case's picture beside it where there is one: [row][column] RGBA, top row
// first. Throws engine::Error "<path>: <reason>".
void saveReport(
    Report report, const hair::RenderSettings& render, std::span<const std::uint8_t> picture,
    const std::filesystem::path& file);

}  // namespace benchmarks
