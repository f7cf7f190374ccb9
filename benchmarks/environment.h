#pragma once

#include <string>
#include <vector>

#include "benchmarks/report.h"
#include "engine/device.h"

namespace benchmarks {

// The program's version and commit, e.g. "hairbench 0.1.0 (1a2b3c4)".
std::string versionText();

// What this program was built from and how.
BuildRecord describeBuild();

// What a report says of the machine, the device, the program and the command line. The start is
// now.
Environment describeEnvironment(
    const engine::Device& device, std::vector<std::string> command, std::uint64_t seed,
    engine::Validation validation);

}  // namespace benchmarks
