#pragma once

#include <ostream>
#include <string>

#include "hair/settings.h"

namespace benchmarks {

// The emitters of a Mitsuba scene: the settings' lights, and their background or, where there is
// one, their environment, whose picture is `environment_file`.
void writeMitsubaLights(
    std::ostream& out, const hair::Settings& settings, const std::string& environment_file);

}  // namespace benchmarks
