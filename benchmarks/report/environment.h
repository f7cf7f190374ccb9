#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/report/report.h"
#include "engine/device.h"

// Describes the device, host and build of a report.
namespace benchmarks::report {

// What a report says of a device. Its limits are Vulkan's, and, where a driver is right only up to
// fewer vertices in a tessellated draw than they allow, "maxTessellatedVertices".
DeviceRecord describeDevice(const engine::Device& device);

// The program's version and commit, e.g. "hairbench 0.1.0 (1a2b3c4)".
std::string versionText();

// What runs where: "hairbench 0.1.0 (abc) on llvmpipe (llvmpipe 22.3.6)".
std::string versionOnDevice(const engine::Device& device);

// The processor's model, as Linux tells it; empty where it does not.
std::string processorName();

// What this program was built from and how.
BuildRecord describeBuild();

// What a report says of the machine, the device, the program and the command line. The start is
// now.
Environment describeEnvironment(
    const engine::Device& device, std::vector<std::string> command, std::uint64_t seed,
    engine::Validation validation);

// 64-bit FNV-1a (Fowler, Noll and Vo 1991) of the bytes in memory order, as 16 lower-case hex
// digits. Reports use it for pictures, simulation states and documents: it tells whether two runs
// made the same thing, and is no protection against someone who wants two things to look the same.
std::string hashBytes(std::span<const std::byte> bytes);
std::string hashText(std::string_view text);

// SHA-256 (FIPS 180-4) of the text, as 64 lower-case hex digits: what sha256sum says of a file.
std::string sha256(std::string_view text);

}  // namespace benchmarks::report
