#include "benchmarks/doctor/doctor_scene.h"

#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "benchmarks/write_settings.h"
#include "engine/write_file.h"
#include "hair/groom/exporters.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kGuides = 48;
constexpr std::uint32_t kVertices = 8;  // of a guide
constexpr double kDisc = 0.08;          // m, its radius
constexpr double kLength = 0.2;         // m, of a guide
constexpr double kLean = 0.6;  // how far the outermost guides lean outward, per metre down

}  // namespace

hair::StrandSet doctorStrands() {
    // Seeds turn by the golden angle, and as many lie on every part of the disc (Vogel 1979, A
    // better way to construct the sunflower head).
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    hair::StrandSet strands;
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

std::string doctorSceneText() { return writeSettings(doctorSettings()).dump(2) + '\n'; }

std::filesystem::path writeDoctorScene(const std::filesystem::path& folder) {
    hair::exportStrands(doctorStrands(), folder / kDoctorStrands);
    const std::filesystem::path scene = folder / "doctor.json";
    engine::writeFileAtomically(scene, doctorSceneText());
    return scene;
}

}  // namespace benchmarks
