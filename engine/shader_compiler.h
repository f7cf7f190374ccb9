#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/shader_library.h"

namespace engine {

// What the compiler says of a shader.
struct ShaderError {
    std::string file;  // relative to the folder of shaders
    int line = 0;      // from 1; 0: of no line
    std::string text;
};

struct CompiledShader {
    ShaderCode code;  // empty where there is an error
    // That were asked for, there or not: the entry point first, then what it includes; each once.
    std::vector<std::string> files;
    // The first: glslang gives up after it, and the rest of what it says is a consequence.
    std::optional<ShaderError> error;
};

// The text of a file, by its path relative to the folder of shaders; none where it can't be read.
using ReadShader = std::function<std::optional<std::string>(const std::string& file)>;

// Compiles GLSL in process, as the build does (scripts/cmake/Shaders.cmake): of the same text comes
// the same code, word for word, where both use the same release of glslang.
class ShaderCompiler {
public:
    ShaderCompiler();
    ~ShaderCompiler();
    ShaderCompiler(const ShaderCompiler&) = delete;
    ShaderCompiler& operator=(const ShaderCompiler&) = delete;

    // `path` is an entry point with its stage as its extension: "strands/strand.frag". Includes are
    // relative to the folder of shaders too, whoever includes them.
    CompiledShader compile(const std::string& path, const ReadShader& read) const;
};

}  // namespace engine
