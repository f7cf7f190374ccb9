#include "benchmarks/doctor/play_pairs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/files.h"

namespace benchmarks::doctor {
namespace {

// ---- The doctor's scene -------------------------------------------------------------------------

constexpr std::uint32_t kGuides = 48;
constexpr std::uint32_t kVertices = 8;  // of a guide
constexpr double kDisc = 0.08;  // m, its radius
constexpr double kLength = 0.2;  // m, of a guide
constexpr double kLean = 0.6;  // outward lean of the outermost guides per metre down

}  // namespace

hair::groom::StrandSet doctorStrands() {
    // Successive roots turn by the golden angle, which gives a uniform density on the disc (Vogel
    // 1979, A better way to construct the sunflower head).
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    hair::groom::StrandSet strands;
    strands.metres_per_unit = 1.0;
    for (std::uint32_t guide = 0; guide < kGuides; ++guide) {
        const double out = std::sqrt((guide + 0.5) / kGuides);
        const double angle = golden_angle * guide;
        const double lean = kLean * out;
        const double step = kLength / (kVertices - 1) / std::sqrt(1.0 + lean * lean);
        for (std::uint32_t vertex = 0; vertex < kVertices; ++vertex) {
            const double down = step * vertex;
            const double radius = kDisc * out + lean * down;
            strands.points.emplace_back(
                radius * std::cos(angle), 0.1 - down, radius * std::sin(angle));
        }
        strands.ends.push_back((guide + 1) * kVertices);
    }
    return strands;
}

hair::Settings doctorSettings() {
    hair::Settings settings;
    settings.description = "A mop of hair in a gusty wind: what `hairbench doctor` measures.";
    settings.groom.file = kDoctorStrands;
    settings.simulation.substeps = 16;
    settings.simulation.wind.strength = 6.0f;
    settings.strands.density = 8;
    settings.strands.tessellation = 2;
    settings.camera.position = {0.0f, 0.05f, 0.3f};
    settings.camera.field_of_view = 60.0f;
    settings.render.width = 320;
    settings.render.height = 180;
    settings.run.frames = 10;
    return settings;
}

std::filesystem::path writeDoctorScene(const std::filesystem::path& folder) {
    hair::groom::exportStrands(doctorStrands(), folder / kDoctorStrands);
    const std::filesystem::path scene = folder / "doctor.json";
    engine::writeFileAtomically(scene, scene::writeSettings(doctorSettings()).dump(2) + '\n');
    return scene;
}

namespace {

// ---- Passes and pairs of equal runs -------------------------------------------------------------

constexpr int kPairs = 12;
constexpr int kRounds = 3;  // of isolated frames

// The cost of a round.
struct Cost {
    double frame;  // ms, median from one frame's start to the next one's
    double cpu;  // ms, of all threads of this process
};

Cost costOf(measure::RoundPlayer& player) {
    const engine::ProcessUse before = engine::processUse();
    std::vector<double> intervals;
    for (const engine::FrameRecord& frame : player.round()) intervals.push_back(frame.interval);
    return {report::summarize(intervals).median, (engine::processUse() - before).cpu};
}

}  // namespace

PassFacts examinePasses(const engine::Device& device, const measure::MeasureHooks& hooks) {
    const engine::ScratchFolder folder;
    writeDoctorScene(folder.path());
    const hair::Settings settings = doctorSettings();
    measure::Case test_case(device, settings, folder.path());
    measure::DeviceStage stage(device, test_case, settings.run, hooks);
    measure::RoundPlayer player(stage.player(engine::Timing::isolated), settings.run);
    // A busy machine only adds time outside the passes or between them. The round with the sum
    // nearest to the wall clock therefore tells most about the device.
    PassFacts facts;
    std::optional<measure::EmptySubmission> empty;
    double nearest = INFINITY;
    for (int i = 0; i < kRounds; ++i) {
        const std::vector<engine::FrameRecord> frames = player.round();
        if (!empty)
            empty = measure::measureEmptySubmission(
                stage, frames.back().device.value_or(frames.back().wall));
        const measure::PassSum sum = measure::passSums(frames, *empty);
        if (!sum.over_wall || std::abs(*sum.over_wall - 1.0) >= nearest) continue;
        nearest = std::abs(*sum.over_wall - 1.0);
        facts.sum = sum;
    }
    report::CaseResult result;
    facts.faults = measure::checkTimestamps(stage, result);
    return facts;
}

RepeatFacts examineRepeat(const engine::Device& device, const measure::MeasureHooks& hooks) {
    const engine::ScratchFolder folder;
    writeDoctorScene(folder.path());
    const hair::Settings settings = doctorSettings();
    measure::Case case_a(device, settings, folder.path());
    measure::Case case_b(device, settings, folder.path());
    measure::DeviceStage stage_a(device, case_a, settings.run, hooks);
    measure::DeviceStage stage_b(device, case_b, settings.run, hooks);
    measure::RoundPlayer a(stage_a.player(engine::Timing::overlapped), settings.run);
    measure::RoundPlayer b(stage_b.player(engine::Timing::overlapped), settings.run);
    // Warms up pipelines and caches.
    a.round();
    b.round();
    RepeatFacts facts;
    for (int pair = 0; pair < kPairs; ++pair) {
        const bool a_first = pair % 2 == 0;
        const Cost first = costOf(a_first ? a : b);
        const Cost second = costOf(a_first ? b : a);
        const double sign = a_first ? 1.0 : -1.0;
        facts.frame.push_back(sign * std::log(second.frame / first.frame));
        facts.cpu.push_back(sign * std::log(second.cpu / first.cpu));
    }
    const measure::RoundEnd end_a = a.lastEnd();
    const measure::RoundEnd end_b = b.lastEnd();
    facts.same_picture =
        end_a.picture_hash == a.firstEnd().picture_hash && end_a.picture_hash == end_b.picture_hash;
    facts.same_state =
        end_a.state_hash == a.firstEnd().state_hash && end_a.state_hash == end_b.state_hash;
    return facts;
}

}  // namespace benchmarks::doctor
