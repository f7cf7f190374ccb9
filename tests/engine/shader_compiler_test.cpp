#include "engine/shaders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/engine/shader_texts.h"

namespace engine {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

CompiledShader compile(const std::string& path, std::map<std::string, std::string> files) {
    const ShaderCompiler compiler;
    return compiler.compile(path, projectShaders(std::move(files)));
}

const std::string kHead = "#version 460\n#extension GL_GOOGLE_include_directive : require\n";

// glslang's own program compiled the embedded shaders: an independent reference for every option.
TEST(ShaderCompiler, MakesTheCodeOfTheBuildWordForWord) {
    const ShaderCompiler compiler;
    for (const std::string_view path : shaderPaths()) {
        const CompiledShader compiled = compiler.compile(std::string(path), projectShaders());
        EXPECT_FALSE(compiled.error) << path;
        const std::span<const std::uint32_t> built = shaderCode(path);
        EXPECT_EQ(compiled.code, ShaderCode(built.begin(), built.end())) << path;
    }
}

TEST(ShaderCompiler, NamesTheIncludedFileAndTheLineOfAnError) {
    const CompiledShader compiled = compile(
        "a.comp", {{"a.comp", kHead + "#include \"b/c.glsl\"\nvoid main() { f(); }\n"},
                   {"b/c.glsl", "// one\n// two\nvoid f() { int x = missing; }\n"}});
    ASSERT_TRUE(compiled.error);
    EXPECT_EQ(compiled.error->file, "b/c.glsl");
    EXPECT_EQ(compiled.error->line, 3);
    EXPECT_THAT(compiled.error->text, HasSubstr("undeclared identifier"));
    EXPECT_THAT(compiled.code, IsEmpty());
    EXPECT_THAT(compiled.files, ElementsAre("a.comp", "b/c.glsl"));
}

TEST(ShaderCompiler, CountsLinesAfterAnIncludeInTheIncludingFile) {
    const CompiledShader compiled = compile(
        "a.comp", {{"a.comp", kHead + "#include \"c.glsl\"\nvoid main() {\n    missing();\n}\n"},
                   {"c.glsl", "\n\n\n\n\n\n"}});
    ASSERT_TRUE(compiled.error);
    EXPECT_EQ(compiled.error->file, "a.comp");
    EXPECT_EQ(compiled.error->line, 5);
}

TEST(ShaderCompiler, ReportsTheFirstError) {
    const CompiledShader compiled =
        compile("a.comp", {{"a.comp", "#version 460\nvoid main() {\n    x = 1;\n    y = 2;\n}\n"}});
    ASSERT_TRUE(compiled.error);
    EXPECT_EQ(compiled.error->line, 3);
    EXPECT_THAT(compiled.error->text, HasSubstr("undeclared identifier"));
}

TEST(ShaderCompiler, SaysWhichIncludeIsMissingAndThatItAskedForIt) {
    const CompiledShader compiled =
        compile("a.comp", {{"a.comp", kHead + "#include \"none.glsl\"\nvoid main() {}\n"}});
    ASSERT_TRUE(compiled.error);
    EXPECT_EQ(compiled.error->line, 3);
    EXPECT_THAT(compiled.error->text, HasSubstr("there is no such file"));
    EXPECT_THAT(compiled.error->text, HasSubstr("none.glsl"));
    EXPECT_THAT(compiled.files, Contains("none.glsl"));
}

TEST(ShaderCompiler, SaysThatAnEntryPointIsMissing) {
    const CompiledShader compiled = compile("none.comp", {});
    ASSERT_TRUE(compiled.error);
    EXPECT_EQ(compiled.error->file, "none.comp");
}

TEST(ShaderCompiler, EndsWhereAFileIncludesItself) {
    const CompiledShader compiled = compile(
        "a.comp", {{"a.comp", kHead + "#include \"b.glsl\"\nvoid main() {}\n"},
                   {"b.glsl", "#include \"c.glsl\"\n"},
                   {"c.glsl", "\n#include \"b.glsl\"\n"}});
    ASSERT_TRUE(compiled.error);
    EXPECT_THAT(compiled.error->text, HasSubstr("includes itself"));
}

TEST(ShaderCompiler, AllowsFilesThatIncludeEachOtherBehindGuards) {
    const auto guarded = [](const std::string& name, const std::string& body) {
        return "#ifndef " + name + "\n#define " + name + "\n" + body + "#endif\n";
    };
    const CompiledShader compiled = compile(
        "a.comp", {{"a.comp", kHead + "#include \"b.glsl\"\nvoid main() {}\n"},
                   {"b.glsl", guarded("B", "#include \"c.glsl\"\n")},
                   {"c.glsl", guarded("C", "#include \"b.glsl\"\n")}});
    EXPECT_FALSE(compiled.error);
    EXPECT_THAT(compiled.code, Not(IsEmpty()));
}

// The macros of the words, and no others.
TEST(ShaderCompiler, DefinesTheWordsOfAVariant) {
    const std::string text = kHead + "#if defined(HAIRBENCH_TWO) || !defined(HAIRBENCH_ONE)\n"
                                     "#error other\n"
                                     "#endif\nvoid main() {}\n";
    const auto named = [&](const std::string& path) { return compile(path, {{"a.comp", text}}); };
    const CompiledShader compiled = named("a.comp+one+three");
    EXPECT_FALSE(compiled.error);
    EXPECT_THAT(compiled.files, ElementsAre("a.comp"));
    for (const char* const path : {"a.comp", "a.comp+three", "a.comp+one+two"}) {
        const CompiledShader other = named(path);
        ASSERT_TRUE(other.error) << path;
        EXPECT_EQ(other.error->file, "a.comp");
        EXPECT_EQ(other.error->line, 4);
    }
}

TEST(ShaderCompiler, RefusesAFileOfNoStage) {
    EXPECT_THROW(compile("common/picture.glsl", {}), Error);
}

}  // namespace
}  // namespace engine
