#include "engine/shader_sources.h"

#include <cstring>

#include "engine/spirv.h"

namespace engine {

namespace {

// UTF-8, four bytes a word, with a zero at its end.
std::string literal(std::span<const std::uint32_t> words) {
    std::string text(words.size_bytes(), '\0');
    std::memcpy(text.data(), words.data(), words.size_bytes());
    return text.substr(0, text.find('\0'));
}

// The build calls included files "./common/picture.glsl".
std::string relative(const std::string& name) {
    return name.starts_with("./") ? name.substr(2) : name;
}

}  // namespace

ShaderSources shaderSources(std::span<const std::uint32_t> code) {
    std::map<std::uint32_t, std::string> names;
    ShaderSources sources;
    std::string* last = nullptr;
    forEachDeclaration(code, [&](SpirvInstruction instruction) {
        const std::span<const std::uint32_t> words = instruction.operands;
        if (instruction.operation == spirv::kString && words.size() > 1) {
            names[words[0]] = literal(words.subspan(1));
        } else if (instruction.operation == spirv::kSource && words.size() > 2) {
            last = &sources[relative(names[words[2]])];  // language, version, file, text
            *last = literal(words.subspan(3));
        } else if (instruction.operation == spirv::kSourceContinued && last) {
            *last += literal(words);
        }
    });
    return sources;
}

}  // namespace engine
