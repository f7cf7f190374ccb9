#pragma once

#include <string>
#include <vector>

#include "benchmarks/report.h"
#include "engine/physical_device.h"

namespace benchmarks {

// The program's version and commit, e.g. "hairbench 0.1.0 (1a2b3c4)".
std::string versionText();

// What a report says of the machine, the device, the program and the command line. The start is
// now.
Environment describeEnvironment(
    const engine::DeviceInfo& device, std::vector<std::string> command, std::uint64_t seed);

}  // namespace benchmarks
