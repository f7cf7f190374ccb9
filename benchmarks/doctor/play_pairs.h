#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/trust.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

// A small scene that needs only the file that it writes itself: a mop of hair in a gusty wind. A
// frame takes milliseconds on a software device and has every pass of the thesis's frame.
namespace benchmarks::doctor {

// The scene's settings. /groom/file is kDoctorStrands, relative to the folder that
// writeDoctorScene() fills.
hair::Settings doctorSettings();

inline constexpr const char* kDoctorStrands = "doctor.hair";

// The guides in kDoctorStrands: they hang from a disc, arranged like a sunflower's seeds.
hair::groom::StrandSet doctorStrands();

// Writes the strands and the scene, "doctor.json", into an existing folder. Returns the scene's
// path. Throws engine::Error.
std::filesystem::path writeDoctorScene(const std::filesystem::path& folder);

// These play the doctor's scene. They throw Interrupted if the hooks request it.

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

// Alternates two cases with the same settings, A B, B A, A B ..., so that a drift of the machine
// raises as many differences as it lowers. It plays 12 pairs of rounds, which all have the same
// frames.
RepeatFacts examineRepeat(const engine::Device& device, const measure::MeasureHooks& hooks);

}  // namespace benchmarks::doctor
