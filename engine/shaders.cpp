#include "engine/shaders.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <regex>
#include <sstream>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "engine/error.h"
#include "engine/pipeline.h"

namespace engine {
namespace {

// ---- Included files -----------------------------------------------------------------------------

// Answers glslang's questions for included files, and notes which it asked for.
class GlslIncluder final : public glslang::TShader::Includer {
public:
    explicit GlslIncluder(const ReadShader& read) : read_(read) {}

    // Serves "" as well as <>: nothing is looked for beside the including file.
    IncludeResult*
    includeSystem(const char* header_name, const char* includer_name, std::size_t depth) override;
    void releaseInclude(IncludeResult* result) override;

    // The files that were asked for, relative to the folder of shaders, in the order of their first
    // time.
    const std::vector<std::string>& files() const { return files_; }

private:
    IncludeResult* open(std::string name, std::string text);

    const ReadShader& read_;
    std::vector<std::string> files_;
    // The files that glslang is within, the innermost last.
    struct Open {
        std::string text;
        std::unique_ptr<IncludeResult> result;
    };
    std::vector<std::unique_ptr<Open>> open_;
};

constexpr std::string_view kFolder = "./";

// What glslang calls an included file, as the build does: its folder is ".".
std::string nameForGlslang(const std::string& file) { return std::string(kFolder) + file; }

std::string fileOfGlslangName(const std::string& name) {
    return name.starts_with(kFolder) ? name.substr(kFolder.size()) : name;
}

GlslIncluder::IncludeResult*
GlslIncluder::includeSystem(const char* header_name, const char*, std::size_t) {
    const std::string file = header_name;
    if (std::ranges::find(files_, file) == files_.end()) files_.push_back(file);
    const std::string name = nameForGlslang(file);
    // Include guards end a file that is within itself once; one that is there twice has none and
    // never ends.
    const auto within = std::ranges::count_if(
        open_, [&](const auto& open) { return open->result->headerName == name; });
    if (within > 1) return open("", "the file includes itself without end");
    std::optional<std::string> text = read_(file);
    if (!text) return open("", "there is no such file in the folder of shaders");
    return open(name, std::move(*text));
}

GlslIncluder::IncludeResult* GlslIncluder::open(std::string name, std::string text) {
    auto opened = std::make_unique<Open>();
    opened->text = std::move(text);
    opened->result = std::make_unique<IncludeResult>(
        std::move(name), opened->text.data(), opened->text.size(), nullptr);
    open_.push_back(std::move(opened));
    return open_.back()->result.get();
}

void GlslIncluder::releaseInclude(IncludeResult* result) {
    std::erase_if(open_, [&](const auto& open) { return open->result.get() == result; });
}

// ---- The compiler -------------------------------------------------------------------------------

constexpr std::array kStages{
    std::pair{".vert", EShLangVertex},         std::pair{".tesc", EShLangTessControl},
    std::pair{".tese", EShLangTessEvaluation}, std::pair{".geom", EShLangGeometry},
    std::pair{".task", EShLangTask},           std::pair{".mesh", EShLangMesh},
    std::pair{".frag", EShLangFragment},       std::pair{".comp", EShLangCompute},
};

EShLanguage stageOf(const std::string& path) {
    for (const auto& [extension, stage] : kStages) {
        if (path.ends_with(extension)) return stage;
    }
    throw Error("shader '" + path + "'", "its extension names no stage");
}

// The first error in a log of lines such as "ERROR: ./common/picture.glsl:12: 'x' : undeclared
// identifier".
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
constexpr int kVulkanGlsl = 100;  // of KHR_vulkan_glsl
constexpr int kDefaultVersion = 100;  // where a shader has no #version
constexpr auto kMessages =
    static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgDebugInfo);

void setTarget(glslang::TShader& shader, EShLanguage stage) {
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, kVulkanGlsl);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
}

// ---- Sources in SPIR-V --------------------------------------------------------------------------

// A text of SPIR-V: UTF-8, four bytes a word, with a zero at its end.
std::string literal(std::span<const std::uint32_t> words) {
    std::string text(words.size_bytes(), '\0');
    std::memcpy(text.data(), words.data(), words.size_bytes());
    return text.substr(0, text.find('\0'));
}

// A path relative to the folder of shaders: the build calls included files "./common/picture.glsl".
std::string relative(const std::string& name) {
    return name.starts_with("./") ? name.substr(2) : name;
}

}  // namespace

// ---- The code of pipelines ----------------------------------------------------------------------

std::span<const std::uint32_t> ShaderLibrary::code(std::string_view path) const {
    const auto replaced = replacements_.find(path);
    return replaced == replacements_.end() ? shaderCode(path) : replaced->second;
}

// ---- Compiling ----------------------------------------------------------------------------------

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

// ---- Sources in SPIR-V --------------------------------------------------------------------------

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
