#include "benchmarks/measure/hair_cache.h"

#include <chrono>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class DiskCacheTest : public testing::Test {
protected:
    DiskCache cache(std::uint64_t most_bytes = 1 << 20) {
        return DiskCache(
            {.folder = folder_.path() / "cache",
             .most_bytes = most_bytes,
             .warn = [this](const std::string& fault) { faults_.push_back(fault); }});
    }

    std::vector<fs::path> files() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder_.path() / "cache"))
            files.push_back(entry.path());
        return files;
    }

    TemporaryFolder folder_;
    std::vector<std::string> faults_;
};

TEST_F(DiskCacheTest, GivesBackWhatItWasGiven) {
    const DiskCache kept = cache();
    const std::map<std::string, std::string> entries{
        {"a", "1"}, {"b\nc", std::string("\0\xff\n", 3)}, {"empty", ""}};
    for (const auto& [key, bytes] : entries) {
        EXPECT_EQ(kept.load(key), std::nullopt);
        kept.store(key, bytes);
    }
    for (const auto& [key, bytes] : entries) EXPECT_EQ(cache().load(key), bytes);
    EXPECT_EQ(kept.load("d"), std::nullopt);
    kept.store("a", "2");
    EXPECT_EQ(kept.load("a"), "2");
    EXPECT_THAT(files(), SizeIs(3));  // no temporary files remain
    EXPECT_THAT(faults_, IsEmpty());
}

// An entry that is truncated anywhere, or has any byte changed, is ignored with a message.
TEST_F(DiskCacheTest, TakesNothingDamaged) {
    const DiskCache kept = cache();
    kept.store("key", "some bytes");
    const fs::path file = kept.fileOf("key");
    const std::string whole = textOf(file);
    const auto replaceBy = [&](const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
    };
    std::size_t told = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        replaceBy(whole.substr(0, i));
        EXPECT_EQ(kept.load("key"), std::nullopt) << i;
        std::string changed = whole;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        replaceBy(changed);
        EXPECT_EQ(kept.load("key"), std::nullopt) << i;
        told += 2;
        ASSERT_EQ(faults_.size(), told);
        EXPECT_THAT(faults_.back(), HasSubstr(file.string()));
    }
    replaceBy(whole + "x");
    EXPECT_EQ(kept.load("key"), std::nullopt);
    kept.store("key", "some bytes");
    EXPECT_EQ(kept.load("key"), "some bytes");
}

// A read from a FIFO without a writer would block, and a read from an endless device would never
// end.
TEST_F(DiskCacheTest, TakesWhatIsAFileAlone) {
    const DiskCache kept = cache();
    kept.store("key", "bytes");
    const fs::path file = kept.fileOf("key");
    fs::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    EXPECT_EQ(kept.load("key"), std::nullopt);
    fs::remove(file);
    fs::create_symlink("/dev/zero", file);
    EXPECT_EQ(kept.load("key"), std::nullopt);
    fs::remove(file);
    fs::create_directory(file);
    EXPECT_EQ(kept.load("key"), std::nullopt);
    fs::remove(file);
    // Its sizes are consistent, and it exceeds the cache's limit: a sparse file without data on
    // disk.
    kept.store("key", "bytes");
    std::string text = textOf(file);
    const std::uint64_t huge = std::uint64_t{1} << 40;
    const std::size_t after_key_size = sizeof "hairbench-cache 1\n" - 1 + sizeof huge;
    text.replace(after_key_size, sizeof huge, reinterpret_cast<const char*>(&huge), sizeof huge);
    std::ofstream(file, std::ios::binary) << text;
    fs::resize_file(file, fs::file_size(file) - 5 + huge);
    faults_.clear();
    EXPECT_EQ(kept.load("key"), std::nullopt);
    EXPECT_THAT(faults_, SizeIs(1));
}

// As for runs that start together.
TEST_F(DiskCacheTest, IsSharedByProcesses) {
    constexpr int kProcesses = 4;
    const std::string bytes(20'000, 'x');
    for (int process = 0; process < kProcesses; ++process) {
        if (fork() != 0) continue;
        bool whole = true;
        const DiskCache kept({.folder = folder_.path() / "cache", .most_bytes = 1 << 20});
        for (int i = 0; i < 200; ++i) {
            const std::string key = "key " + std::to_string(i % 10);
            const auto found = kept.load(key);
            whole &= !found || *found == bytes + key;
            kept.store(key, bytes + key);
        }
        _exit(whole ? 0 : 1);
    }
    for (int process = 0; process < kProcesses; ++process) {
        int status = -1;
        ASSERT_GT(wait(&status), 0);
        EXPECT_EQ(status, 0);
    }
    for (int i = 0; i < 10; ++i) {
        const std::string key = "key " + std::to_string(i);
        EXPECT_EQ(cache().load(key), bytes + key);
    }
    EXPECT_THAT(files(), SizeIs(10));
    EXPECT_THAT(faults_, IsEmpty());
}

// As if two keys had the same hash.
TEST_F(DiskCacheTest, TakesNothingOfAnotherKey) {
    const DiskCache kept = cache();
    kept.store("one", "bytes");
    fs::rename(kept.fileOf("one"), kept.fileOf("other"));
    EXPECT_EQ(kept.load("other"), std::nullopt);
    ASSERT_THAT(faults_, SizeIs(1));
    EXPECT_THAT(faults_.front(), HasSubstr("belongs to other data; it is ignored"));
}

TEST_F(DiskCacheTest, WhatWasUsedLongestAgoGoesFirst) {
    const DiskCache kept = cache(4096);  // three entries of a thousand bytes, with their headers
    const std::string bytes(1000, 'x');
    const auto now = fs::file_time_type::clock::now();
    for (const char* key : {"a", "b", "c"}) kept.store(key, bytes);
    fs::last_write_time(kept.fileOf("a"), now - std::chrono::hours(3));
    fs::last_write_time(kept.fileOf("b"), now - std::chrono::hours(2));
    fs::last_write_time(kept.fileOf("c"), now - std::chrono::hours(1));
    EXPECT_TRUE(kept.load("a"));  // now it is the most recently used
    kept.store("d", bytes);
    EXPECT_FALSE(kept.load("b"));
    for (const char* key : {"a", "c", "d"}) EXPECT_TRUE(kept.load(key)) << key;
    kept.store("large", std::string(1025, 'x'));  // more than a quarter
    EXPECT_FALSE(kept.load("large"));
    std::uintmax_t sum = 0;
    for (const fs::path& file : files()) sum += fs::file_size(file);
    EXPECT_LE(sum, 4096u);
}

// A process that is killed while it writes an entry leaves a temporary file, named as
// engine::replaceFile() does. Other processes may be writing one now, but not for hours.
TEST_F(DiskCacheTest, RemovesWhatKilledProcessesLeft) {
    const DiskCache kept = cache();
    kept.store("a", "1");
    const fs::path old(kept.fileOf("b").string() + ".0123456789abcdef.partial");
    const fs::path young(kept.fileOf("b").string() + ".fedcba9876543210.partial");
    const fs::path other = folder_.write("cache/notes.txt", "of the user");
    for (const fs::path& path : {old, young}) std::ofstream(path) << "half an entry";
    const auto now = fs::file_time_type::clock::now();
    fs::last_write_time(old, now - std::chrono::hours(2));
    fs::last_write_time(other, now - std::chrono::hours(2));
    kept.store("c", "3");
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(young));
    EXPECT_TRUE(fs::exists(other));
}

TEST_F(DiskCacheTest, IsOffWithoutAFolderAndSilentWhereItCanNotWrite) {
    const DiskCache off({});
    off.store("a", "1");
    EXPECT_FALSE(off.isOn());
    EXPECT_EQ(off.load("a"), std::nullopt);
    folder_.write("cache", "a file where the folder should be");
    cache().store("a", "1");
    EXPECT_EQ(cache().load("a"), std::nullopt);
    EXPECT_THAT(faults_, IsEmpty());
}

}  // namespace
}  // namespace benchmarks::measure
