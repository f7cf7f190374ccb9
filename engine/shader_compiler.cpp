#include "engine/shader_compiler.h"

#include <array>
#include <regex>
#include <sstream>
#include <utility>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "engine/error.h"
#include "engine/glsl_includer.h"

namespace engine {

namespace {

constexpr std::array kStages{
    std::pair{".vert", EShLangVertex},         std::pair{".tesc", EShLangTessControl},
    std::pair{".tese", EShLangTessEvaluation}, std::pair{".geom", EShLangGeometry},
    std::pair{".frag", EShLangFragment},       std::pair{".comp", EShLangCompute},
};

EShLanguage stageOf(const std::string& path) {
    for (const auto& [extension, stage] : kStages) {
        if (path.ends_with(extension)) return stage;
    }
    throw Error("shader '" + path + "'", "its extension names no stage");
}

// Of a log of lines such as "ERROR: ./common/picture.glsl:12: 'x' : undeclared identifier".
ShaderError firstError(const std::string& log, const std::string& path) {
    static const std::regex located(R"((?:INTERNAL )?ERROR: (.+?):(\d+): (.*))");
    static const std::regex other(R"((?:INTERNAL )?ERROR: (.*))");
    std::istringstream lines(log);
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
        if (std::regex_match(line, match, located))
            return {fileOfGlslangName(match[1]), std::stoi(match[2]), match[3]};
        if (std::regex_match(line, match, other)) return {path, 0, match[1]};
    }
    return {path, 0, "does not compile: " + log};
}

// --target-env vulkan1.3 -g, as glslang's own program has it. (TShader::setDebugInfo is for -gV:
// without it, code with blocks in functions comes out invalid.)
constexpr int kVulkanGlsl = 100;     // of KHR_vulkan_glsl
constexpr int kDefaultVersion = 100;  // where a shader has no #version
constexpr auto kMessages =
    static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgDebugInfo);

void setTarget(glslang::TShader& shader, EShLanguage stage) {
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, kVulkanGlsl);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
}

}  // namespace

ShaderCompiler::ShaderCompiler() { glslang::InitializeProcess(); }
ShaderCompiler::~ShaderCompiler() { glslang::FinalizeProcess(); }

CompiledShader ShaderCompiler::compile(const std::string& path, const ReadShader& read) const {
    const EShLanguage stage = stageOf(path);
    CompiledShader compiled{.code = {}, .files = {path}, .error = {}};
    const std::optional<std::string> text = read(path);
    if (!text) {
        compiled.error = {path, 0, "there is no such file in the folder of shaders"};
        return compiled;
    }

    const char* const string = text->data();
    const int length = static_cast<int>(text->size());
    const char* const name = path.c_str();
    glslang::TShader shader(stage);
    shader.setStringsWithLengthsAndNames(&string, &length, &name, 1);
    setTarget(shader, stage);
    GlslIncluder includer(read);
    const bool parsed =
        shader.parse(GetDefaultResources(), kDefaultVersion, false, kMessages, includer);
    compiled.files.insert(compiled.files.end(), includer.files().begin(), includer.files().end());
    if (!parsed) {
        compiled.error = firstError(shader.getInfoLog(), path);
        return compiled;
    }

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kMessages) || !program.mapIO()) {
        compiled.error = firstError(program.getInfoLog(), path);
        return compiled;
    }
    glslang::SpvOptions options;
    options.generateDebugInfo = true;
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(*program.getIntermediate(stage), compiled.code, &logger, &options);
    return compiled;
}

}  // namespace engine
