#include "benchmarks/doctor/own_gate.h"

#include <utility>

#include "benchmarks/doctor/doctor_scene.h"

namespace benchmarks {

namespace {

// This program, even where its file was replaced since it was started.
constexpr const char* kThisProgram = "/proc/self/exe";

}  // namespace

OwnGate::OwnGate(const engine::DeviceOptions& device)
    : device_(device), scene_(writeDoctorScene(folder_.path())) {}

GateOptions OwnGate::options(std::vector<std::string> b_sets) const {
    GateOptions options;
    options.a = options.b = kThisProgram;
    options.scene.scene = scene_;
    options.scene.device = device_;
    options.scene.max_time = 0.0;
    options.b_sets = std::move(b_sets);
    return options;
}

}  // namespace benchmarks
