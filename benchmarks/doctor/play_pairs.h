#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/trust.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

// A small scene that needs no file but one that it writes itself: a mop of hair in a gusty wind, a
// frame of which takes milliseconds on a software device and has every pass of the thesis's frame.
namespace benchmarks::doctor {

// The scene's settings; /groom/file is kDoctorStrands, relative to the folder that
// writeDoctorScene() fills.
hair::Settings doctorSettings();

inline constexpr const char* kDoctorStrands = "doctor.hair";

// The guides that kDoctorStrands holds: hanging from a disc, spread like a sunflower's seeds.
hair::groom::StrandSet doctorStrands();

// Writes the strands and the scene, "doctor.json", into the folder, which exists. Returns the
// scene's path. Throws engine::Error.
std::filesystem::path writeDoctorScene(const std::filesystem::path& folder);

// Plays the doctor's scene. Throws Interrupted where the hooks say so.

// How times of passes add up in the doctor's scene.
struct PassFacts {
    measure::PassSum sum;  // of isolated passes
    std::vector<std::string> faults;  // of timestamps against submit-and-wait
};

// Two cases of equal settings, played in turns.
struct RepeatFacts {
    bool same_picture = false;
    bool same_state = false;
    std::vector<double> frame;  // [pair], ln(B/A) of the median frame time
    std::vector<double> cpu;    // [pair], ln(B/A) of the process's CPU time
};

// How the passes add up, and whether timestamps say what the CPU's clock does.
PassFacts examinePasses(const engine::Device& device, const measure::MeasureHooks& hooks);

// Two cases of the same settings in turns, A B, B A, A B ..., so that a drift of the machine raises
// as many differences as it lowers: 12 pairs, of rounds that each play the same frames.
RepeatFacts examineRepeat(const engine::Device& device, const measure::MeasureHooks& hooks);

}  // namespace benchmarks::doctor
