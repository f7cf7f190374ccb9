#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Shaders: the SPIR-V that is compiled into the program, what replaces it while the program runs,
// the compiler, and the sources that SPIR-V carries.
namespace engine {

using ShaderCode = std::vector<std::uint32_t>;  // SPIR-V

// GLSL that does not come with the program: functions that an entry point calls. It is a
// compilation unit of its own, so that it sees nothing of the program's shaders but `interface`,
// which declares what both sides define: none of their names, buffers or extensions.
struct ShaderExtension {
    std::string interface;  // "extension/shading.glsl": entry points that include it call it
    std::string macro;  // that is defined for them
    std::string declarations;  // before the text, each on the line of the file that it is from
    std::string name;  // of the file, as errors have it
    std::string text;
};
using ShaderExtensions = std::vector<std::shared_ptr<const ShaderExtension>>;

// The code that pipelines are made of: what was compiled into the program (shaderCode()), or what
// took its place since.
class ShaderLibrary {
public:
    // Code by entry point, "simulation/wind.comp".
    using Replacements = std::map<std::string, ShaderCode, std::less<>>;

    // The code of an entry point, valid until replace(). An unknown path throws Error and lists the
    // known ones.
    std::span<const std::uint32_t> code(std::string_view path) const;

    // The same with those of the extensions that it calls, which are compiled at their first time.
    // Throws Error "<file>:<line>: <reason>" for one that does not compile. Thread-safe but for
    // replace().
    std::shared_ptr<const ShaderCode>
    extended(std::string_view path, const ShaderExtensions& extensions) const;

    // These and no others are replaced from now on; paths that the program has no code of are
    // added. Pipelines that exist keep their code.
    void replace(Replacements replacements) { replacements_ = std::move(replacements); }
    const Replacements& replacements() const { return replacements_; }

private:
    static constexpr std::size_t kMostExtended = 256;

    Replacements replacements_;
    mutable std::mutex mutex_;
    // By all that they were compiled of.
    mutable std::map<std::string, std::shared_ptr<const ShaderCode>> extended_;
};

// What the compiler says of a shader.
struct ShaderError {
    std::string file;  // relative to the folder of shaders
    int line = 0;  // from 1; 0: not known
    std::string text;
};

struct CompiledShader {
    ShaderCode code;  // empty where there is an error
    // The files that were asked for, there or not: the entry point first, then what it includes;
    // each once.
    std::vector<std::string> files;
    // The first error: glslang gives up after it, and the rest of what it says is a consequence.
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
    // With extensions that the entry point calls the code is of all of them together, and has no
    // sources in it; an error is in the file that it says, under the extension's name.
    CompiledShader compile(
        const std::string& path, const ReadShader& read,
        const ShaderExtensions& extensions = {}) const;
};

// The SPIR-V of an entry point under shaders/, compiled into the program: "simulation/wind.comp".
// The code lives as long as the program. An unknown path throws Error and lists the known ones. The
// list of shaders is the call of hairbench_shaders() in CMake.
std::span<const std::uint32_t> shaderCode(std::string_view path);

// The entry points that are compiled into the program.
std::vector<std::string_view> shaderPaths();

// Texts of GLSL files by their paths relative to the folder of shaders.
using ShaderSources = std::map<std::string, std::string, std::less<>>;

// The files that SPIR-V was compiled from: glslang's -g leaves them in the code (OpSource). They
// are ASCII; glslang 12 spoils other letters.
ShaderSources shaderSources(std::span<const std::uint32_t> code);

}  // namespace engine
