#pragma once

#include <filesystem>
#include <string>

#include "hair/groom/strand_set.h"
#include "hair/settings.h"

// A small scene that needs no file but one that it writes itself: a mop of hair in a gusty wind, a
// frame of which takes milliseconds on a software device and has every pass of the thesis's frame.
namespace benchmarks {

// Its /groom/file is kDoctorStrands, relative to the folder that writeDoctorScene() fills.
hair::Settings doctorSettings();

inline constexpr const char* kDoctorStrands = "doctor.hair";

// The guides that kDoctorStrands holds: hanging from a disc, spread like a sunflower's seeds.
hair::StrandSet doctorStrands();

// doctorSettings() as a scene file.
std::string doctorSceneText();

// Writes the strands and the scene, "doctor.json", into the folder, which exists. Returns the
// scene's path. Throws engine::Error.
std::filesystem::path writeDoctorScene(const std::filesystem::path& folder);

}  // namespace benchmarks
