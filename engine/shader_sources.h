#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace engine {

// Texts of GLSL files by their paths relative to the folder of shaders.
using ShaderSources = std::map<std::string, std::string, std::less<>>;

// The files that SPIR-V was compiled from: glslang's -g leaves them in the code (OpSource). They
// are ASCII; glslang 12 spoils other letters.
ShaderSources shaderSources(std::span<const std::uint32_t> code);

}  // namespace engine
