#pragma once

#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "engine/instance.h"
#include "tests/temporary_folder.h"

namespace benchmarks {

// A made-up report with one case of each status and every possible member.
inline report::Report sampleReport() {
    report::Report report;
    report.environment = {
        .device =
            {.name = "Soft",
             .type = engine::DeviceType::cpu,
             .driver = "llvmpipe",
             .driver_version = "22.3.6",
             .api_version = "1.3.230",
             .timestamp_period_ns = 1.0,
             .id = "10005:0000",
             .timestamp_valid_bits = 64,
             .limits = {{"maxTessellationGenerationLevel", 64.0}, {"timestampPeriod", 1.0}}},
        .host = {"Debian 12", "Some CPU", 2, 4096},
        .build = {"0.1.0", "abc", "GCC 12.2", "Release", "-O3 -DNDEBUG", false},
        .command = {"hairbench", "run", "scenes/thesis.json"},
        .started = "2030-01-02T03:04:05Z",
        .seed = 7,
        .validation = false};
    report.scene = {
        "scenes/thesis.json", "0123456789abcdef", scene::Document(scene::Json{{"seed", 7}})};
    report.case_count = 6;
    report.order_seed = 11;
    report.shard = {.index = 1, .count = 2};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    report.cases.push_back(
        {.name = "thesis/density:64/backend:tessellation",
         .index = 0,
         .order = 2,
         .axes =
             {{"/strands/density", scene::Document(64)},
              {"/strands/backend", scene::Document("tessellation")}},
         .memory_need = report::MemoryNeed{.device = 2097152, .host = 134217728},
         .backend = {.name = "tessellation", .reason = "the scene names it"},
         .start =
             report::StartRecord{
                 .from = "relaxed",
                 .rest = "balanced",
                 .stretch = {.value = 1.25, .guide = 4, .guides = 2},
                 .depth = {.value = nan, .guide = 3, .guides = 1},
                 .stiffened = 5,
                 .stiffest = 1.5,
                 .unbalanced = 0},
         .metrics =
             {{report::ofFrame(report::Measured::time),
               {2.0, 4.0, 3.0, nan},
               report::Mode::overlapped},
              {report::ofFrame(report::Measured::rate), {333.25}, report::Mode::overlapped},
              {report::ofPass("wind", report::Measured::time), {0.0125}, report::Mode::isolated},
              {report::ofPass("strands", report::Measured::time), {2.5}, report::Mode::isolated},
              {report::ofPass("ui", report::Measured::time), {nan}, report::Mode::isolated},
              {report::ofMemory(report::Measured::allocated), {1048576.0}}},
         .statistics =
             {{"tessellation_control_patches", 952, 952, ""},
              {"geometry_primitives", 5, {}, "no count is known"}},
         .counts = {{"guides", 86}, {"strands", 8704}},
         .sampling =
             {{.mode = "overlapped",
               .rounds = 3,
               .warmup_rounds = 1,
               .throttled_rounds = 2,
               .seconds = 1.5,
               .steady = true,
               .precision = 0.0078125},
              {.mode = "isolated", .rounds = 1, .steady = {}, .precision = {}}},
         .conditions =
             {.clock_mhz = 1500.0,
              .base_clock_mhz = 1400.0,
              .memory_clock_mhz = 5000.0,
              .temperature = 61.5,
              .steal = 0.25,
              .other_load = 0.5,
              .throttle_reasons = {"power cap"}},
         .trust = {.pass_sum_over_wall = 0.99, .warnings = {"clock fell"}},
         .image_hash = "00000000000000ff",
         .state_hash = "cbf29ce484222325",
         .picture = "thesis.pictures/0.png"});
    report.cases.push_back(
        {.name = "thesis/density:64/backend:mesh",
         .index = 2,
         .order = 0,
         .axes =
             {{"/strands/density", scene::Document(64)},
              {"/strands/backend", scene::Document("mesh")}},
         .status = report::Status::skipped,
         .reason = "the device has no VK_EXT_mesh_shader, which the back end needs"});
    report.cases.push_back(
        {.name = "thesis/density:64/backend:lines",
         .index = 4,
         .order = 1,
         .axes =
             {{"/strands/density", scene::Document(64)},
              {"/strands/backend", scene::Document("lines")}},
         .status = report::Status::failed,
         .reason = "device lost"});
    return report;
}

// Has more samples of the frame's time than fit a report's own file.
inline report::Report manySamples() {
    report::Report report = sampleReport();
    std::vector<double>& samples = report.cases[0].metrics[0].samples;
    samples.clear();
    for (int i = 0; i < 2001; ++i) samples.push_back(1.0 + i % 7 * 0.1);
    return report;
}

// Returns the text of the file to which the report is written.
inline std::string writtenText(const report::Report& report) {
    const TemporaryFolder folder;
    report::writeReport(report::reportJson(report), folder.file("report.json"));
    return textOf(folder.file("report.json"));
}

}  // namespace benchmarks
