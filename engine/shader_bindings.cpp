#include "engine/shader_bindings.h"

#include <map>

#include "engine/spirv.h"

namespace engine {

std::set<ShaderBinding> shaderBindings(std::span<const std::uint32_t> code) {
    // Decorations: SPIR-V specification, 3.20.
    constexpr std::uint32_t kBinding = 33;
    constexpr std::uint32_t kDescriptorSet = 34;
    std::map<std::uint32_t, ShaderBinding> found;  // by variable
    std::set<std::uint32_t> bound;
    forEachDeclaration(code, [&](SpirvInstruction instruction) {
        if (instruction.operation != spirv::kDecorate || instruction.operands.size() < 3) return;
        const std::uint32_t variable = instruction.operands[0];
        if (instruction.operands[1] == kDescriptorSet)
            found[variable].set = instruction.operands[2];
        if (instruction.operands[1] == kBinding) {
            found[variable].binding = instruction.operands[2];
            bound.insert(variable);
        }
    });
    std::set<ShaderBinding> bindings;
    for (const std::uint32_t variable : bound) bindings.insert(found[variable]);
    return bindings;
}

}  // namespace engine
