#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace engine {

// The SPIR-V of an entry point under shaders/, compiled into the program: "simulation/wind.comp".
// It lives as long as the program. An unknown path throws Error and lists the known ones.
// The list of shaders is the call of hairbench_shaders() in CMake.
std::span<const std::uint32_t> shaderCode(std::string_view path);

// All of them.
std::vector<std::string_view> shaderPaths();

}  // namespace engine
