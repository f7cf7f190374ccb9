#include "engine/pipeline.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "engine/shaders.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace {

// Each test has its own cache folder while it runs.
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

    // Creates a cache and destroys it, which writes the file.
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

// Length and version of the header: Vulkan 1.3, table "Layout for pipeline cache header version
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
    other_device[8] = static_cast<char>(~other_device[8]);  // vendor id
    for (const std::string& bad : {std::string("x"), std::string(1000, 'x'), other_device}) {
        std::ofstream(files()[0], std::ios::binary) << bad;
        makeCache();
        EXPECT_EQ(textOf(files()[0]).substr(0, 12), good.substr(0, 12));
    }
}

// Drivers check the first bytes, and not all drivers check more.
TEST_F(PipelineCacheTest, IgnoresDamagedData) {
    makeCache();
    ASSERT_EQ(files().size(), 1u);
    const std::filesystem::path file = files()[0];
    const std::string good = textOf(file);
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string damaged = good;
        damaged[i] = static_cast<char>(damaged[i] ^ 1);
        std::ofstream(file, std::ios::binary) << damaged;
        makeCache();
        EXPECT_EQ(textOf(file), good) << i;  // recreated and written
    }
    std::ofstream(file, std::ios::binary) << good.substr(0, good.size() - 1);
    makeCache();
    EXPECT_EQ(textOf(file), good);
}

// Reading a pipe without a writer would wait forever, and an endless file would never finish.
TEST_F(PipelineCacheTest, IgnoresWhatIsNoFile) {
    makeCache();
    ASSERT_EQ(files().size(), 1u);
    const std::filesystem::path file = files()[0];
    const std::string good = textOf(file);
    std::filesystem::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    makeCache();
    EXPECT_EQ(textOf(file), good);
    std::filesystem::remove(file);
    std::filesystem::create_symlink("/dev/zero", file);
    makeCache();
    EXPECT_EQ(textOf(file), good);
    std::filesystem::resize_file(file, std::uintmax_t{1} << 40);
    makeCache();
    EXPECT_EQ(textOf(file), good);
}

// Removes other drivers' files, the least recently used first.
TEST_F(PipelineCacheTest, KeepsAQuarterGibibyteOfAll) {
    const std::filesystem::path folder = folder_.path() / "hairbench";
    const auto now = std::filesystem::file_time_type::clock::now();
    const auto add = [&](const char* name, int hours) {
        const auto path = folder_.write(std::string("hairbench/") + name, "");
        std::filesystem::resize_file(path, std::uintmax_t{100} << 20);
        std::filesystem::last_write_time(path, now - std::chrono::hours(hours));
        return path;
    };
    const auto old = add("pipelines-a-1.bin", 3), older = add("pipelines-b-1.bin", 9);
    const auto young = add("pipelines-c-1.bin", 1), other = add("notes.txt", 20);
    makeCache();
    EXPECT_FALSE(std::filesystem::exists(older));
    for (const auto& kept : {old, young, other}) EXPECT_TRUE(std::filesystem::exists(kept));
}

TEST_F(PipelineCacheTest, DoesWithoutAFolderToWriteTo) {
    const std::filesystem::path file = folder_.write("file", "");
    setenv("XDG_CACHE_HOME", file.c_str(), 1);
    makeCache();
    EXPECT_EQ(files().size(), 1u);
}

using PipelineStoreTest = GpuTest;

ComputeDescription resolveOf(std::uint32_t samples) {
    return {
        .shader = "post/resolve.comp",
        .constants = {{0, 1u}, {1, samples}},
        .sampled_images = 1,
        .storage_images = 1};
}

TEST_F(PipelineStoreTest, GivesOnePipelineForEqualDescriptions) {
    const ComputePipeline one(device(), resolveOf(2));
    ComputeDescription turned = resolveOf(2);
    std::swap(turned.constants[0], turned.constants[1]);
    EXPECT_EQ(ComputePipeline(device(), turned).get(), one.get());
    EXPECT_NE(ComputePipeline(device(), resolveOf(3)).get(), one.get());
}

// Like a shader that is saved while the viewer runs.
TEST_F(PipelineStoreTest, GivesAnotherForOtherCode) {
    const ComputePipeline before(device(), resolveOf(2));
    const std::span<const std::uint32_t> other = shaderCode("busy/busy.comp");
    device().shaders().replace({{"post/resolve.comp", ShaderCode(other.begin(), other.end())}});
    const ComputePipeline replaced(
        device(), {.shader = "post/resolve.comp", .push_size = sizeof(std::uint64_t) * 2});
    device().shaders().replace({});
    EXPECT_NE(replaced.get(), before.get());
    EXPECT_EQ(ComputePipeline(device(), resolveOf(2)).get(), before.get());
}

// Keeps pipelines in use, however many others were created since.
TEST_F(PipelineStoreTest, LetsGoOfWhatWasAskedForLongAgo) {
    PipelineStore store;
    const auto made = [&](int i) {
        return store.get(std::to_string(i), [] { return PipelineObjects{}; });
    };
    const PipelineStore::Objects kept = made(0);
    const std::weak_ptr<const PipelineObjects> dropped = made(1);
    for (int i = 2; i < 2000; ++i) made(i);
    EXPECT_TRUE(dropped.expired());
    EXPECT_EQ(kept.use_count(), 1);
    EXPECT_NE(made(0), kept);
}

}  // namespace
}  // namespace engine
