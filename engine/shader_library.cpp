#include "engine/shader_library.h"

#include "engine/shader_code.h"

namespace engine {

std::span<const std::uint32_t> ShaderLibrary::code(std::string_view path) const {
    const auto replaced = replacements_.find(path);
    return replaced == replacements_.end() ? shaderCode(path) : replaced->second;
}

}  // namespace engine
