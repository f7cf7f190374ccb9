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

// Describes a device for a report. The limits are Vulkan's. Where a driver handles only fewer
// vertices in a tessellated draw correctly, "maxTessellatedVertices" gives its limit.
DeviceRecord describeDevice(const engine::Device& device);

// The program's version and commit, e.g. "hairbench 0.1.0 (1a2b3c4)".
std::string versionText();

// The version and the device: "hairbench 0.1.0 (abc) on llvmpipe (llvmpipe 22.3.6)".
std::string versionOnDevice(const engine::Device& device);

// Returns the source version, compiler and flags of this build.
BuildRecord describeBuild();

// Describes the machine, device, program and command line for a report. Takes the current time as
// the start.
Environment describeEnvironment(
    const engine::Device& device, std::vector<std::string> command, std::uint64_t seed,
    engine::Validation validation);

// 64-bit FNV-1a (Fowler, Noll and Vo 1991) of the bytes in memory order, as 16 lower-case hex
// digits. Reports use it for pictures, simulation states and documents to tell whether two runs
// gave the same result. It does not protect against deliberate collisions.
std::string hashBytes(std::span<const std::byte> bytes);
std::string hashText(std::string_view text);

// SHA-256 (FIPS 180-4) of the text, as 64 lower-case hex digits, like the output of sha256sum.
std::string sha256(std::string_view text);

}  // namespace benchmarks::report
