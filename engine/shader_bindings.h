#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <span>

namespace engine {

// A place that SPIR-V expects a descriptor at.
struct ShaderBinding {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;

    auto operator<=>(const ShaderBinding&) const = default;
};

std::set<ShaderBinding> shaderBindings(std::span<const std::uint32_t> code);

}  // namespace engine
