#include "engine/shaders.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "engine/error.h"
#include "engine/run_tool.h"
#include "engine/spirv_judge.h"

namespace engine {
namespace {

// ---- Included files -----------------------------------------------------------------------------

// Answers glslang's requests for included files and notes the files.
class GlslIncluder final : public glslang::TShader::Includer {
public:
    explicit GlslIncluder(const ReadShader& read) : read_(read) {}

    // Serves both "" and <>: the folder of the including file is not searched.
    IncludeResult*
    includeSystem(const char* header_name, const char* includer_name, std::size_t depth) override;
    void releaseInclude(IncludeResult* result) override;

    // Requested files, relative to the shader folder, in the order of their first request.
    const std::vector<std::string>& files() const { return files_; }

private:
    IncludeResult* open(std::string name, std::string text);

    const ReadShader& read_;
    std::vector<std::string> files_;
    // Files being included, innermost last.
    struct Open {
        std::string text;
        std::unique_ptr<IncludeResult> result;
    };
    std::vector<std::unique_ptr<Open>> open_;
};

constexpr std::string_view kFolder = "./";

// glslang's name of an included file, as in the build: its folder is ".".
std::string nameForGlslang(const std::string& file) { return std::string(kFolder) + file; }

std::string fileOfGlslangName(const std::string& name) {
    return name.starts_with(kFolder) ? name.substr(kFolder.size()) : name;
}

GlslIncluder::IncludeResult*
GlslIncluder::includeSystem(const char* header_name, const char*, std::size_t) {
    const std::string file = header_name;
    if (std::ranges::find(files_, file) == files_.end()) files_.push_back(file);
    const std::string name = nameForGlslang(file);
    // A file with an include guard is open within itself at most once. A file that is open twice
    // has no guard and never ends.
    const auto within = std::ranges::count_if(
        open_, [&](const auto& open) { return open->result->headerName == name; });
    if (within > 1) return open("", "the file includes itself endlessly");
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

struct Stage {
    const char* extension;
    EShLanguage language;
    const char* layout = "";  // smallest declaration that a shader of the stage needs
    const char* directive = "";  // required in each unit of the stage
};
constexpr const char* kMeshDirective = "#extension GL_EXT_mesh_shader : require\n";
constexpr std::array kStages{
    Stage{".vert", EShLangVertex},
    Stage{".tesc", EShLangTessControl, "layout(vertices = 1) out;"},
    Stage{".tese", EShLangTessEvaluation, "layout(isolines) in;"},
    Stage{".geom", EShLangGeometry, "layout(points) in; layout(points, max_vertices = 1) out;"},
    Stage{".task", EShLangTask, "", kMeshDirective},
    Stage{
        ".mesh", EShLangMesh, "layout(points, max_vertices = 1, max_primitives = 1) out;",
        kMeshDirective},
    Stage{".frag", EShLangFragment},
    Stage{".comp", EShLangCompute},
};

const Stage& stageOf(const std::string& file) {
    for (const Stage& stage : kStages) {
        if (file.ends_with(stage.extension)) return stage;
    }
    throw Error("shader '" + file + "'", "its extension names no stage");
}

// The file of an entry point and the macros of its variant: "rod.comp+packed" is the file
// "rod.comp" with HAIRBENCH_PACKED.
struct Variant {
    explicit Variant(const std::string& path) : file(shaderFile(path)) {
        std::istringstream words(path.substr(std::min(file.size() + 1, path.size())));
        for (std::string word; std::getline(words, word, '+');) {
            std::ranges::transform(word, word.begin(), [](unsigned char c) {
                return static_cast<char>(std::toupper(c));
            });
            macros.push_back("HAIRBENCH_" + word);
        }
    }

    std::string file;
    std::vector<std::string> macros;
};

// Returns the first error in a log of lines such as "ERROR: ./common/picture.glsl:12: 'x' :
// undeclared identifier".
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

// The same as --target-env vulkan1.3 -g of glslang's own program. (TShader::setDebugInfo belongs to
// -gV: without -gV it makes invalid code for blocks in functions.)
constexpr int kVulkanGlsl = 100;  // version of KHR_vulkan_glsl
constexpr int kDefaultVersion = 100;  // for a shader without #version
constexpr auto kMessages =
    static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgDebugInfo);

void setTarget(glslang::TShader& shader, EShLanguage stage) {
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, kVulkanGlsl);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
}

// A compilation unit that does not come with the program. An error in a declaration names its line
// in the file.
struct ExtensionUnit {
    ExtensionUnit(const ShaderExtension& extension, const ReadShader& read, const Stage& stage)
        : head(
              std::string("#version 460\n") + stage.directive +
              read(extension.interface).value_or("") + "bool " + kNextTurn + "();\n"),
          shader(stage.language) {
        const std::array texts{
            head.c_str(), extension.declarations.c_str(), extension.text.c_str()};
        const std::array lengths{
            static_cast<int>(head.size()), static_cast<int>(extension.declarations.size()),
            static_cast<int>(extension.text.size())};
        const std::array names{
            extension.interface.c_str(), extension.name.c_str(), extension.name.c_str()};
        shader.setStringsWithLengthsAndNames(
            texts.data(), lengths.data(), names.data(), static_cast<int>(texts.size()));
        setTarget(shader, stage.language);
        if (!shader.parse(GetDefaultResources(), kDefaultVersion, false, kMessages))
            error = firstError(shader.getInfoLog(), extension.name);
    }

    std::string head;
    glslang::TShader shader;
    std::optional<ShaderError> error;
};

// Some of glslang's messages end in a space.
std::string withoutEnd(const std::string& text) {
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

// Returns "shadeHair" for "vec3 shadeHair(HairPoint point)".
std::string nameOfFunction(const std::string& signature) {
    const std::size_t end = signature.find('(');
    const std::size_t begin = signature.rfind(' ', end) + 1;
    return signature.substr(begin, end - begin);
}

// Returns an error from linking the units. It has no line and is attributed to an extension,
// because the program's own units fit together. glslang calls a function there "name(u1;".
ShaderError linkError(const std::string& log, const ShaderExtension& extension) {
    static const std::regex signature(R"(\n\s*(\w+)\()");
    static const std::regex constant(R"(Initializers must match:\s*(\w+))");
    std::smatch match;
    if (std::regex_search(log, match, constant))
        return {
            extension.name, 0,
            "'" + match[1].str() + "' is a constant of another file too: rename one"};
    if (!std::regex_search(log, match, signature))
        return {extension.name, 0, firstError(log, extension.name).text};
    const std::string function = match[1];
    if (log.find("Recursion detected") != std::string::npos)
        return {extension.name, 0, "'" + function + "' calls itself: recursion is not permitted"};
    if (log.find("Multiple function bodies") != std::string::npos)
        return {
            extension.name, 0,
            "'" + function + "' has the name of one of the program's own functions: rename it"};
    if (function == nameOfFunction(extension.function))
        return {extension.name, 0, "has no function " + extension.function};
    return {extension.name, 0, "'" + function + "' is declared but not defined"};
}

// Judges an extension linked with its stand-in instead of the program's shaders. So the judged code
// contains none of the program's own code, which may use more than an extension may.
std::optional<ShaderError>
judge(const ShaderExtension& extension, const ReadShader& read, const Stage& stage) {
    ExtensionUnit unit(extension, read, stage);
    if (unit.error) {
        if (unit.error->text.find('\'' + nameOfFunction(extension.function) + '\'') !=
            std::string::npos)
            unit.error->text = withoutEnd(unit.error->text) + "; expected " + extension.function;
        return unit.error;
    }
    const ShaderExtension stand_in{
        .interface = extension.interface,
        .macro = {},
        .declarations = std::string(stage.layout) + " bool " + kNextTurn + "() { return true; }",
        .name = "main",
        .text = extension.stand_in};
    ExtensionUnit rest(stand_in, read, stage);
    if (rest.error) return rest.error;
    glslang::TProgram program;
    program.addShader(&unit.shader);
    program.addShader(&rest.shader);
    if (!program.link(kMessages)) return linkError(program.getInfoLog(), extension);
    glslang::SpvOptions options;
    options.generateDebugInfo = true;  // for the line numbers
    spv::SpvBuildLogger logger;
    ShaderCode code;
    glslang::GlslangToSpv(*program.getIntermediate(stage.language), code, &logger, &options);
    const std::optional<SpirvFault> fault = judgeSpirv(code);
    if (!fault) return std::nullopt;
    return ShaderError{
        extension.name, fault->file == extension.name ? fault->line : 0, fault->text};
}

// ---- Compiling in a fork ------------------------------------------------------------------------

// Limits for compiling foreign text. A short text can keep a compiler busy for ever.
constexpr ChildLimits kCompileLimits{.seconds = 20, .bytes = std::size_t{2} << 30};

std::string bytesOf(const CompiledShader& compiled) {
    if (compiled.error) {
        return 'E' + std::to_string(compiled.error->line) + '\n' + compiled.error->file + '\n' +
               withoutEnd(compiled.error->text);
    }
    return 'C' + std::string(
                     reinterpret_cast<const char*>(compiled.code.data()),
                     compiled.code.size() * sizeof(std::uint32_t));
}

// Throws the error that the bytes contain.
ShaderCode codeOf(const std::string& bytes) {
    if (bytes.starts_with('E')) {
        const std::size_t line = bytes.find('\n');
        const std::size_t file = bytes.find('\n', line + 1);
        const std::string number = bytes.substr(1, line - 1);
        throw Error(
            bytes.substr(line + 1, file - line - 1) + (number == "0" ? "" : ':' + number),
            bytes.substr(file + 1));
    }
    ShaderCode code((bytes.size() - 1) / sizeof(std::uint32_t));
    std::memcpy(code.data(), bytes.data() + 1, code.size() * sizeof(std::uint32_t));
    return code;
}

// ---- Sources in SPIR-V --------------------------------------------------------------------------

// Returns a path relative to the shader folder: the build calls included files
// "./common/picture.glsl".
std::string relative(const std::string& name) {
    return name.starts_with("./") ? name.substr(2) : name;
}

}  // namespace

// ---- The code of pipelines ----------------------------------------------------------------------

std::span<const std::uint32_t> ShaderLibrary::code(std::string_view path) const {
    const auto replaced = replacements_.find(path);
    return replaced == replacements_.end() ? shaderCode(path) : replaced->second;
}

std::shared_ptr<const ShaderCode>
ShaderLibrary::extended(std::string_view path, const ShaderExtensions& extensions) const {
    const std::span<const std::uint32_t> own = code(path);
    const auto as_it_is = [&] {
        return std::make_shared<const ShaderCode>(own.begin(), own.end());
    };
    if (extensions.empty()) return as_it_is();
    const ShaderSources sources = shaderSources(own);
    ShaderExtensions called;
    std::string key(path);
    for (const auto& extension : extensions) {
        if (!sources.contains(extension->interface)) continue;
        called.push_back(extension);
        for (const std::string* part :
             {&extension->interface, &extension->declarations, &extension->name, &extension->text})
            key += '\0' + std::to_string(part->size()) + '\0' + *part;
    }
    if (called.empty()) return as_it_is();
    for (const auto& [file, text] : sources) key += '\0' + text;

    const std::lock_guard lock(mutex_);
    if (const auto known = extended_.find(key); known != extended_.end()) return known->second;
    const std::string name(path);
    const std::string bytes = [&] {
        try {
            return runApart(
                [&] {
                    const auto read = [&](const std::string& file) -> std::optional<std::string> {
                        const auto found = sources.find(file);
                        if (found == sources.end()) return std::nullopt;
                        return found->second;
                    };
                    return bytesOf(ShaderCompiler().compile(name, read, called));
                },
                kCompileLimits);
        } catch (const Error& error) {
            throw Error(
                called.front()->name, "could not be compiled: " + std::string(error.what()));
        }
    }();
    auto code = std::make_shared<const ShaderCode>(codeOf(bytes));
    const std::set<ShaderBinding> had = shaderBindings(own);
    for (const ShaderBinding& binding : shaderBindings(*code))
        if (!had.contains(binding))
            throw Error(called.front()->name, "uses a buffer or an image, which is not permitted");
    if (extended_.size() >= kMostExtended) extended_.clear();
    extended_.emplace(std::move(key), code);
    return code;
}

// ---- Compiling ----------------------------------------------------------------------------------

ShaderCompiler::ShaderCompiler() { glslang::InitializeProcess(); }
ShaderCompiler::~ShaderCompiler() { glslang::FinalizeProcess(); }

CompiledShader ShaderCompiler::compile(
    const std::string& path, const ReadShader& read, const ShaderExtensions& extensions) const {
    const Variant variant(path);
    const std::string& file = variant.file;
    const Stage& stage = stageOf(file);
    CompiledShader compiled{.code = {}, .files = {file}, .error = {}};
    const std::optional<std::string> text = read(file);
    if (!text) {
        compiled.error = {file, 0, "there is no such file in the folder of shaders"};
        return compiled;
    }

    const char* const string = text->data();
    const int length = static_cast<int>(text->size());
    const char* const name = file.c_str();
    glslang::TShader shader(stage.language);
    shader.setStringsWithLengthsAndNames(&string, &length, &name, 1);
    setTarget(shader, stage.language);
    std::string macros;
    std::vector<std::string> processes;  // the compiler's record of -D in the build
    for (const std::string& macro : variant.macros) {
        macros += "#define " + macro + " \n";
        processes.push_back("define-macro " + macro);
    }
    shader.addProcesses(processes);
    for (const auto& extension : extensions) macros += "#define " + extension->macro + " 1\n";
    shader.setPreamble(macros.c_str());
    GlslIncluder includer(read);
    const bool parsed =
        shader.parse(GetDefaultResources(), kDefaultVersion, false, kMessages, includer);
    compiled.files.insert(compiled.files.end(), includer.files().begin(), includer.files().end());
    if (!parsed) {
        compiled.error = firstError(shader.getInfoLog(), file);
        return compiled;
    }

    // Declared before the program, which refers to them.
    std::vector<std::unique_ptr<ExtensionUnit>> units;
    glslang::TProgram program;
    for (const auto& extension : extensions) {
        compiled.error = judge(*extension, read, stage);
        if (compiled.error) return compiled;
        const auto& unit =
            units.emplace_back(std::make_unique<ExtensionUnit>(*extension, read, stage));
        program.addShader(&unit->shader);
    }
    // Last: its stage settings apply where earlier units have none.
    program.addShader(&shader);
    if (!program.link(kMessages) || !program.mapIO()) {
        compiled.error = extensions.empty() ? firstError(program.getInfoLog(), file)
                                            : linkError(program.getInfoLog(), *extensions.front());
        return compiled;
    }
    glslang::SpvOptions options;
    options.generateDebugInfo = extensions.empty();
    spv::SpvBuildLogger logger;
    glslang::GlslangToSpv(
        *program.getIntermediate(stage.language), compiled.code, &logger, &options);
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
            names[words[0]] = spirvText(words.subspan(1));
        } else if (instruction.operation == spirv::kSource && words.size() > 2) {
            last = &sources[relative(names[words[2]])];  // language, version, file, text
            *last = spirvText(words.subspan(3));
        } else if (instruction.operation == spirv::kSourceContinued && last) {
            *last += spirvText(words);
        }
    });
    return sources;
}

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
