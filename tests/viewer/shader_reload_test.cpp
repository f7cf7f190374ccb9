#include "benchmarks/viewer/shader_reload.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "engine/frame_loop.h"
#include "engine/shaders.h"
#include "tests/gpu_fixture.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::SizeIs;

// Tests in a copy of the project's shaders.
class ShaderReloadTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        std::filesystem::copy(
            HAIRBENCH_SOURCE_DIR "/shaders", folder.path(),
            std::filesystem::copy_options::recursive);
    }
    void TearDown() override {
        if (GpuEnvironment::device()) device().shaders().replace({});
        GpuTest::TearDown();
    }

    std::string text(const std::string& file) const { return textOf(folder.file(file)); }

    // Replaces a text in a file and saves it.
    void edit(const std::string& file, const std::string& from, const std::string& to) {
        std::string content = text(file);
        const std::size_t at = content.find(from);
        ASSERT_NE(at, std::string::npos) << file << " has no " << from;
        folder.write(file, content.replace(at, from.size(), to));
    }

    // Polls until poll() or `ends` returns true. The limit only ends a failing test.
    template <class Ends>
    static bool pollUntil(ShaderReload& reload, Ends&& ends) {
        const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
        while (std::chrono::steady_clock::now() < limit) {
            if (reload.poll()) return true;
            if (ends()) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        ADD_FAILURE() << "nothing happened";
        return false;
    }
    static bool pollUntilReloaded(ShaderReload& reload) {
        return pollUntil(reload, [] { return false; });
    }
    static void pollUntilProblem(ShaderReload& reload) {
        EXPECT_FALSE(pollUntil(reload, [&] { return !reload.problems().empty(); }));
    }

    static std::string pictureHash() {
        hair::Settings settings;
        settings.simulation.solver = hair::Solver::none;
        settings.groom.guides = 8;
        settings.strands.backend = hair::Backend::tessellation;
        settings.strands.density = 2;
        settings.strands.tessellation = 1;
        settings.render.width = 64;
        settings.render.height = 36;
        measure::Case picture(device(), settings, HAIRBENCH_SCENES_DIR);
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
        loop.finish();
        return picture.pictureHash();
    }

    static inline const std::string kColor = "vec4(strandColor(picture, visible), 1.0)";
    static inline const std::string kGreen = "vec4(0.0, 1.0, 0.0, 1.0)";
    TemporaryFolder folder;
};

TEST_F(ShaderReloadTest, DrawsWithWhatWasSavedAndAgainWithWhatWasThere) {
    ShaderReload reload(device(), folder.path());
    EXPECT_TRUE(reload.watches());
    const std::string before = pictureHash();
    edit("strands/strand.frag", kColor, kGreen);
    ASSERT_TRUE(pollUntilReloaded(reload));
    EXPECT_NE(pictureHash(), before);
    reload.accept();
    EXPECT_THAT(reload.reloaded().paths, ElementsAre("strands/strand.frag"));
    EXPECT_THAT(reload.changed(), ElementsAre("strands/strand.frag"));
    EXPECT_THAT(reload.problems(), IsEmpty());

    edit("strands/strand.frag", kGreen, kColor);
    ASSERT_TRUE(pollUntilReloaded(reload));
    reload.accept();
    EXPECT_EQ(pictureHash(), before);
    EXPECT_THAT(reload.changed(), IsEmpty());
    EXPECT_THAT(device().shaders().replacements(), IsEmpty());  // the program's own code
}

TEST_F(ShaderReloadTest, FindsWhatChangedBeforeItStarted) {
    edit("strands/strand.frag", kColor, kGreen);
    ShaderReload reload(device(), folder.path());
    ASSERT_TRUE(pollUntilReloaded(reload));
    EXPECT_TRUE(device().shaders().replacements().contains("strands/strand.frag"));
}

TEST_F(ShaderReloadTest, ReloadsEveryShaderThatIncludesAFile) {
    ShaderReload reload(device(), folder.path());
    edit("common/display_color.glsl", "1.055", "1.0550");
    ASSERT_TRUE(pollUntilReloaded(reload));
    reload.accept();
    EXPECT_THAT(
        reload.reloaded().paths, IsSupersetOf({"post/develop.comp", "strands/strand.frag"}));
    EXPECT_FALSE(device().shaders().replacements().contains("simulation/wind.comp"));
}

TEST_F(ShaderReloadTest, KeepsThePictureWhileAFileIsBroken) {
    ShaderReload reload(device(), folder.path());
    const std::string before = pictureHash();
    // A valid change in another file waits for the broken one.
    edit("strands/strand.frag", kColor, kGreen);
    folder.write("common/display_color.glsl", text("common/display_color.glsl") + "\nbroken\n");
    pollUntilProblem(reload);
    EXPECT_THAT(device().shaders().replacements(), IsEmpty());
    EXPECT_EQ(pictureHash(), before);

    folder.write(
        "common/display_color.glsl",
        textOf(HAIRBENCH_SOURCE_DIR "/shaders/common/display_color.glsl"));
    ASSERT_TRUE(pollUntilReloaded(reload));
    reload.accept();
    EXPECT_THAT(reload.problems(), IsEmpty());
    EXPECT_THAT(reload.reloaded().paths, ElementsAre("strands/strand.frag"));
}

TEST_F(ShaderReloadTest, NamesTheIncludedFileTheLineAndItsTextOnce) {
    ShaderReload reload(device(), folder.path());
    const std::string original = text("common/display_color.glsl");
    const auto line = 1 + std::ranges::count(original.substr(0, original.find("curved =")), '\n');
    edit("common/display_color.glsl", "curved =", "curved = missing +");
    pollUntilProblem(reload);
    ASSERT_THAT(reload.problems(), SizeIs(1));  // although many shaders include it
    const ShaderProblem& problem = reload.problems().front();
    EXPECT_EQ(problem.file, "common/display_color.glsl");
    EXPECT_EQ(problem.line, line);
    EXPECT_THAT(problem.text, HasSubstr("undeclared identifier"));
    EXPECT_THAT(problem.source, HasSubstr("curved = missing +"));
}

TEST_F(ShaderReloadTest, PutsBackTheLastGoodCodeWhereItIsRejected) {
    ShaderReload reload(device(), folder.path());
    edit("strands/strand.frag", kColor, kGreen);
    ASSERT_TRUE(pollUntilReloaded(reload));
    reload.accept();
    const engine::ShaderLibrary::Replacements good = device().shaders().replacements();
    edit("strands/strand.frag", kGreen, "vec4(0.0, 0.0, 1.0, 1.0)");
    ASSERT_TRUE(pollUntilReloaded(reload));
    EXPECT_NE(device().shaders().replacements(), good);
    reload.reject("the device refuses it");
    EXPECT_EQ(device().shaders().replacements(), good);
    ASSERT_THAT(reload.problems(), SizeIs(1));
    EXPECT_EQ(reload.problems().front().file, "strands/strand.frag");
    EXPECT_EQ(reload.problems().front().text, "the device refuses it");

    // The rejected code is tried again only after a file has changed.
    edit("strands/strand.frag", "vec4(0.0, 0.0, 1.0, 1.0)", kGreen);
    EXPECT_FALSE(pollUntil(reload, [&] { return reload.problems().empty(); }));
    EXPECT_EQ(device().shaders().replacements(), good);
}

TEST_F(ShaderReloadTest, DoesNotReloadWhatIsSharedWithTheProgram) {
    ShaderReload reload(device(), folder.path());
    folder.write("shared/light_structs.h", "#error not compiled\n");
    EXPECT_FALSE(pollUntil(reload, [&] { return !reload.changed().empty(); }));
    EXPECT_THAT(reload.changed(), ElementsAre("shared/light_structs.h"));
    EXPECT_TRUE(ShaderReload::needsRebuild(reload.changed().front()));
    EXPECT_THAT(reload.problems(), IsEmpty());

    // Shaders that include it are compiled with the build's version.
    edit("strands/strand.frag", kColor, kGreen);
    ASSERT_TRUE(pollUntilReloaded(reload));
}

TEST_F(ShaderReloadTest, RefusesAnImageThatTheProgramDoesNotBind) {
    ShaderReload reload(device(), folder.path());
    edit(
        "strands/strand.frag", "layout(location = 0) out vec4 color;",
        "layout(location = 0) out vec4 color;\n"
        "layout(binding = 9) uniform sampler2D more;");
    edit("strands/strand.frag", kColor, "texture(more, vec2(0.0))");
    pollUntilProblem(reload);
    ASSERT_THAT(reload.problems(), Not(IsEmpty()));
    EXPECT_THAT(reload.problems().front().text, HasSubstr("binding 9 of set 0"));
    EXPECT_THAT(device().shaders().replacements(), IsEmpty());
}

TEST_F(ShaderReloadTest, ReloadsANewFileThatIsIncluded) {
    ShaderReload reload(device(), folder.path());
    edit(
        "strands/strand.frag", "#include \"strands/fragment.glsl\"",
        "#include \"strands/fragment.glsl\"\n#include \"strands/new.glsl\"");
    edit("strands/strand.frag", kColor, "newColor()");
    pollUntilProblem(reload);
    ASSERT_THAT(reload.problems(), Not(IsEmpty()));
    EXPECT_THAT(reload.problems().front().text, HasSubstr("strands/new.glsl"));
    folder.write("strands/new.glsl", "vec4 newColor() { return vec4(1.0); }\n");
    ASSERT_TRUE(pollUntilReloaded(reload));
    reload.accept();
    EXPECT_THAT(reload.changed(), ElementsAre("strands/new.glsl", "strands/strand.frag"));
}

TEST_F(ShaderReloadTest, ReportsAFileThatStaysAway) {
    ShaderReload reload(device(), folder.path());
    std::filesystem::remove(folder.file("strands/strand.frag"));
    pollUntilProblem(reload);
    ASSERT_THAT(reload.problems(), Not(IsEmpty()));
    EXPECT_EQ(reload.problems().front().file, "strands/strand.frag");
}

TEST_F(ShaderReloadTest, WatchesNothingWhereThereIsNothing) {
    ShaderReload nowhere(device(), folder.path() / "none");
    EXPECT_FALSE(nowhere.watches());
    EXPECT_THAT(nowhere.problems(), IsEmpty());
    const TemporaryFolder other;
    ShaderReload elsewhere(device(), other.path());
    EXPECT_FALSE(elsewhere.watches());
    EXPECT_THAT(elsewhere.problems(), Not(IsEmpty()));
    EXPECT_FALSE(elsewhere.poll());
}

}  // namespace
}  // namespace benchmarks::viewer
