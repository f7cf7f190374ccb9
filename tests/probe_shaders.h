#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/device.h"
#include "engine/shaders.h"
#include "hair/gpu_structs.h"

namespace hair::gpu {
#include "tests/shaders/probe_structs.h"
}

// The shaders of tests/shaders/. They call the program's GLSL functions, but do not belong to the
// program.
namespace probe_shaders {

// Like engine::shaderCode() and engine::shaderPaths(). Paths are e.g. "probe_fiber.comp".
std::span<const std::uint32_t> shaderCode(std::string_view path);
std::vector<std::string_view> shaderPaths();

// Lets the device make pipelines from these shaders too.
inline void addTo(const engine::Device& device) {
    engine::ShaderLibrary::Replacements all = device.shaders().replacements();
    for (const std::string_view path : shaderPaths()) {
        const std::span<const std::uint32_t> code = shaderCode(path);
        all.try_emplace(std::string(path), code.begin(), code.end());
    }
    device.shaders().replace(std::move(all));
}

}  // namespace probe_shaders
