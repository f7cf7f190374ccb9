#include "engine/device.h"

#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace {

// Each test has a cache folder of its own for as long as it runs.
class PipelineCacheTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (const char* old = std::getenv("XDG_CACHE_HOME")) old_ = old;
        setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    }

    void TearDown() override {
        if (old_) {
            setenv("XDG_CACHE_HOME", old_->c_str(), 1);
        } else {
            unsetenv("XDG_CACHE_HOME");
        }
        GpuTest::TearDown();
    }

    // Makes a cache and lets go of it, which writes it.
    static void makeCache() { const PipelineCache cache(device().get(), device().info()); }

    std::vector<std::filesystem::path> files() const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
            if (entry.is_regular_file()) found.push_back(entry.path());
        }
        return found;
    }

    TemporaryFolder folder_;
    std::optional<std::string> old_;
};

// The header's length and version: Vulkan 1.3, table "Layout for pipeline cache header version
// one".
constexpr std::string_view kHeaderStart("\x20\0\0\0\1\0\0\0", 8);

TEST_F(PipelineCacheTest, IsOneFileNamedAfterTheDriver) {
    makeCache();
    ASSERT_EQ(files().size(), 1u);
    EXPECT_EQ(files()[0].parent_path().filename(), "hairbench");
    EXPECT_EQ(textOf(files()[0]).substr(0, 8), kHeaderStart);
    makeCache();
    EXPECT_EQ(files().size(), 1u);
}

TEST_F(PipelineCacheTest, IgnoresAFileThatIsNotACache) {
    makeCache();
    ASSERT_EQ(files().size(), 1u);
    const std::string good = textOf(files()[0]);
    std::string other_device = good;
    other_device[8] = static_cast<char>(~other_device[8]);  // the vendor
    for (const std::string& bad : {std::string("x"), std::string(1000, 'x'), other_device}) {
        std::ofstream(files()[0], std::ios::binary) << bad;
        makeCache();
        EXPECT_EQ(textOf(files()[0]).substr(0, 12), good.substr(0, 12));
    }
}

TEST_F(PipelineCacheTest, DoesWithoutAFolderToWriteTo) {
    const std::filesystem::path file = folder_.write("file", "");
    setenv("XDG_CACHE_HOME", file.c_str(), 1);
    makeCache();
    EXPECT_EQ(files().size(), 1u);
}

}  // namespace
}  // namespace engine
