#include "engine/shaders.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/engine/shader_texts.h"

namespace engine {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

TEST(ShaderLibrary, HasTheCodeOfTheProgramUntilItIsReplaced) {
    ShaderLibrary library;
    const std::span<const std::uint32_t> built = shaderCode("busy/busy.comp");
    EXPECT_EQ(library.code("busy/busy.comp").data(), built.data());
    library.replace({{"busy/busy.comp", {1, 2, 3}}});
    EXPECT_THAT(library.code("busy/busy.comp"), ElementsAre(1u, 2u, 3u));
    EXPECT_EQ(library.code("post/develop.comp").data(), shaderCode("post/develop.comp").data());
    library.replace({});
    EXPECT_EQ(library.code("busy/busy.comp").data(), built.data());
}

TEST(ShaderLibrary, TakesCodeOfPathsThatTheProgramDoesNotHave) {
    ShaderLibrary library;
    library.replace({{"none.comp", {1, 2, 3}}});
    EXPECT_THAT(library.code("none.comp"), ElementsAre(1u, 2u, 3u));
}

TEST(ShaderLibrary, ThrowsForAnUnknownShader) {
    EXPECT_THROW(ShaderLibrary().code("none.comp"), Error);
}

// Compares with the files themselves.
TEST(ShaderSources, AreTheFilesThatTheProgramWasBuiltFrom) {
    const ReadShader read = projectShaders();
    for (const std::string_view path : shaderPaths()) {
        const ShaderSources sources = shaderSources(shaderCode(path));
        EXPECT_TRUE(sources.contains(shaderFile(path))) << path;
        for (const auto& [file, text] : sources) EXPECT_EQ(text, read(file)) << path << ' ' << file;
    }
    EXPECT_TRUE(
        shaderSources(shaderCode("strands/strand.frag")).contains("shared/strand_structs.h"));
}

// More than 65,535 words, the limit of one instruction.
TEST(ShaderSources, HoldALongFileWhole) {
    const std::string text = "#version 460\n" + std::string(300'000, '/') + "\nvoid main() {}\n";
    const CompiledShader compiled =
        ShaderCompiler().compile("long.comp", projectShaders({{"long.comp", text}}));
    EXPECT_THAT(shaderSources(compiled.code), ElementsAre(Pair("long.comp", text)));
}

TEST(ShaderSources, OfWhatIsNoCodeAreNone) {
    EXPECT_THAT(shaderSources({}), IsEmpty());
    const std::vector<std::uint32_t> cut(
        shaderCode("busy/busy.comp").begin(), shaderCode("busy/busy.comp").begin() + 40);
    EXPECT_NO_THROW(shaderSources(cut));
}

}  // namespace
}  // namespace engine
