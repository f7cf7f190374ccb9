#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <glslang/Public/ShaderLang.h>

#include "engine/shader_compiler.h"

namespace engine {

// Answers glslang's questions for included files, and notes which it asked for.
class GlslIncluder final : public glslang::TShader::Includer {
public:
    explicit GlslIncluder(const ReadShader& read) : read_(read) {}

    // For "" as well as <>: nothing is looked for beside the including file.
    IncludeResult*
    includeSystem(const char* header_name, const char* includer_name, std::size_t depth) override;
    void releaseInclude(IncludeResult* result) override;

    // Relative to the folder of shaders, in the order in which they were first asked for.
    const std::vector<std::string>& files() const { return files_; }

private:
    IncludeResult* open(std::string name, std::string text);

    const ReadShader& read_;
    std::vector<std::string> files_;
    // Those that glslang is within, the innermost last.
    struct Open {
        std::string text;
        std::unique_ptr<IncludeResult> result;
    };
    std::vector<std::unique_ptr<Open>> open_;
};

// What glslang calls an included file, as the build does: its folder is ".".
std::string nameForGlslang(const std::string& file);
std::string fileOfGlslangName(const std::string& name);

}  // namespace engine
