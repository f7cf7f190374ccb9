#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Shaders: the SPIR-V compiled into the program, its replacement at run time, the compiler, and the
// inspection of SPIR-V: its bindings and the sources embedded in it.
namespace engine {

using ShaderCode = std::vector<std::uint32_t>;  // SPIR-V

// GLSL functions from outside the program, called by an entry point. They are a separate
// compilation unit, so they see only `interface` of the program's shaders, which declares the
// functions of both sides, and no other names, buffers or extensions.
struct ShaderExtension {
    std::string interface;  // "extension/shading.glsl": included by the entry points that call it
    std::string macro;  // defined for those entry points
    std::string declarations;  // precede the text, each with its line number in the file
    std::string name;  // of the file, in errors
    std::string text;
    std::string function{};  // that the text must define: "vec3 shadeHair(HairPoint point)"
    // GLSL that defines the functions of the program's side, and a main() that calls the function.
    // The extension is linked with it and judged before it is linked with the program's shaders.
    std::string stand_in{};
};
// A function of the program's that the conditions of an extension's loops call: false ends the
// loop.
inline constexpr const char* kNextTurn = "hairbenchNextTurn";

using ShaderExtensions = std::vector<std::shared_ptr<const ShaderExtension>>;

// Code for pipelines: compiled into the program (shaderCode()), or its replacement.
class ShaderLibrary {
public:
    // Code by entry point or variant, as for shaderCode().
    using Replacements = std::map<std::string, ShaderCode, std::less<>>;

    // Returns the code of an entry point, valid until replace(). For an unknown path throws an
    // Error that lists the known ones.
    std::span<const std::uint32_t> code(std::string_view path) const;

    // Returns the code linked with the extensions that it calls. Compiles it at first use. Throws
    // Error "<file>:<line>: <reason>" if an extension does not compile or judgeSpirv() refuses it.
    // Thread-safe, except with replace().
    std::shared_ptr<const ShaderCode>
    extended(std::string_view path, const ShaderExtensions& extensions) const;

    // Replaces exactly these from now on; adds paths that the program has no code for. Existing
    // pipelines keep their code.
    void replace(Replacements replacements) { replacements_ = std::move(replacements); }
    const Replacements& replacements() const { return replacements_; }

private:
    static constexpr std::size_t kMostExtended = 256;

    Replacements replacements_;
    mutable std::mutex mutex_;
    // by a text of everything that the code was compiled from
    mutable std::map<std::string, std::shared_ptr<const ShaderCode>> extended_;
};

// Returns the file of an entry point or a variant: "rod.comp" for "rod.comp+packed".
inline std::string_view shaderFile(std::string_view path) { return path.substr(0, path.find('+')); }

struct ShaderError {
    std::string file;  // relative to the shader folder
    int line = 0;  // from 1; 0: unknown
    std::string text;
};

struct CompiledShader {
    ShaderCode code;  // empty on error
    // All requested files, found or not: first the entry point, then its includes; each once.
    std::vector<std::string> files;
    // The first error. glslang gives up after it, and later messages only follow from it.
    std::optional<ShaderError> error;
};

// Returns the text of a file, by its path relative to the shader folder; none if it can't be read.
using ReadShader = std::function<std::optional<std::string>(const std::string& file)>;

// Compiles GLSL in process, as the build does (scripts/cmake/Shaders.cmake). The same text gives
// the same code, word for word, if both use the same release of glslang.
class ShaderCompiler {
public:
    ShaderCompiler();
    ~ShaderCompiler();
    ShaderCompiler(const ShaderCompiler&) = delete;
    ShaderCompiler& operator=(const ShaderCompiler&) = delete;

    // `path`: an entry point, with its stage as extension, "strands/strand.frag", or a variant of
    // it, "simulation/rod.comp+packed", for which HAIRBENCH_PACKED is defined. Includes are
    // always relative to the shader folder, whichever file includes them. With extensions, all
    // units are linked together and the code carries no sources; an error in an extension has the
    // extension's name as its file. A fault that judgeSpirv() finds in an extension by itself is
    // an error too.
    CompiledShader compile(
        const std::string& path, const ReadShader& read,
        const ShaderExtensions& extensions = {}) const;
};

// Returns the SPIR-V of an entry point under shaders/, or of a variant of one, compiled into the
// program: "simulation/wind.comp", "simulation/rod.comp+packed". The code lives as long as the
// program. For an unknown path throws an Error that lists the known ones. The call of
// hairbench_shaders() in CMake lists the shaders.
std::span<const std::uint32_t> shaderCode(std::string_view path);

// Returns the entry points compiled into the program.
std::vector<std::string_view> shaderPaths();

// Texts of GLSL files by their paths relative to the shader folder.
using ShaderSources = std::map<std::string, std::string, std::less<>>;

// Returns the files that SPIR-V was compiled from: glslang's -g leaves them in the code (OpSource).
// They are ASCII; glslang 12 garbles other characters.
ShaderSources shaderSources(std::span<const std::uint32_t> code);

// A descriptor binding that SPIR-V declares.
struct ShaderBinding {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;

    auto operator<=>(const ShaderBinding&) const = default;
};

// Returns all descriptor bindings that a shader's code declares.
std::set<ShaderBinding> shaderBindings(std::span<const std::uint32_t> code);

}  // namespace engine
