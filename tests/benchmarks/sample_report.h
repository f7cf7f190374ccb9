#pragma once

#include <limits>

#include "benchmarks/report.h"

namespace benchmarks {

// A made-up report with one case of each status, in which everything that can be said is said.
inline Report sampleReport() {
    Report report;
    report.environment = {
        .device = {"Soft", "cpu", "llvmpipe", "22.3.6", "1.3.230", 1.0},
        .host = {"Debian 12", "Some CPU", 2, 4096},
        .build = {"0.1.0", "abc", "GCC 12.2", "Release"},
        .command = {"hairbench", "run", "scenes/thesis.json"},
        .started = "2030-01-02T03:04:05Z",
        .seed = 7};
    report.scene = {"scenes/thesis.json", "0123456789abcdef", R"({"seed":7})"};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    report.cases.push_back(
        {.name = "thesis/density:64/backend:tessellation",
         .axes = {{"/strands/density", "64"}, {"/strands/backend", "\"tessellation\""}},
         .metrics =
             {{"frame.time", "ms", {2.0, 4.0, 3.0, nan}, "overlapped"},
              {"fps", "1/s", {333.25}, "overlapped"},
              {"pass.wind.time", "ms", {0.0125}, "isolated"},
              {"pass.strands.time", "ms", {2.5}, "isolated"},
              {"pass.ui.time", "ms", {nan}, "isolated"},
              {"memory.device", "B", {1048576.0}, ""}},
         .statistics =
             {{"tessellation_control_patches", 952, 952, ""},
              {"geometry_primitives", 5, {}, "no count is known"}},
         .counts = {{"guides", 86}, {"strands", 8704}},
         .trust = {.pass_sum_over_wall = 0.99, .warnings = {"clock fell"}},
         .image_hash = "00000000000000ff",
         .state_hash = "cbf29ce484222325"});
    report.cases.push_back(
        {.name = "thesis/density:64/backend:mesh",
         .axes = {{"/strands/density", "64"}, {"/strands/backend", "\"mesh\""}},
         .status = Status::skipped,
         .reason = "the device has no VK_EXT_mesh_shader, which the back end needs"});
    report.cases.push_back(
        {.name = "thesis/density:64/backend:lines",
         .axes = {{"/strands/density", "64"}, {"/strands/backend", "\"lines\""}},
         .status = Status::failed,
         .reason = "device lost"});
    return report;
}

}  // namespace benchmarks
