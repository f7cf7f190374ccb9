#include "benchmarks/viewer/shader_reload.h"

#include <chrono>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

class WatchedFilesTest : public testing::Test {
protected:
    // Saves a file with a later time than the last save.
    void write(const std::string& name, const std::string& text) {
        folder.write(name, text);
        time_ += std::chrono::seconds(1);
        std::filesystem::last_write_time(folder.file(name), time_);
    }

    TemporaryFolder folder;
    WatchedFiles files{folder.path()};

private:
    std::filesystem::file_time_type time_ = std::filesystem::file_time_type::clock::now();
};

TEST_F(WatchedFilesTest, TellOfAChangeOnceItLooksTheSameTwice) {
    write("a", "one");
    files.watch("a", "one");
    EXPECT_FALSE(files.look());
    EXPECT_FALSE(files.look());
    write("a", "two");
    EXPECT_FALSE(files.look());
    EXPECT_EQ(files.text("a"), "one");
    EXPECT_TRUE(files.look());
    EXPECT_EQ(files.text("a"), "two");
    EXPECT_FALSE(files.look());
}

TEST_F(WatchedFilesTest, FindWhatWasDifferentFromTheStart) {
    write("a", "two");
    files.watch("a", "one");
    EXPECT_FALSE(files.look());
    EXPECT_TRUE(files.look());
    EXPECT_EQ(files.text("a"), "two");
}

TEST_F(WatchedFilesTest, TakeNoNoticeOfAFileThatIsEmptyForOneLook) {
    write("a", "one");
    files.watch("a", "one");
    files.look();
    files.look();
    write("a", "");
    EXPECT_FALSE(files.look());
    write("a", "two");
    EXPECT_FALSE(files.look());
    EXPECT_TRUE(files.look());
    EXPECT_EQ(files.text("a"), "two");
}

TEST_F(WatchedFilesTest, TakeNoNoticeOfAFileThatIsGoneForOneLook) {
    write("a", "one");
    files.watch("a", "one");
    files.look();
    files.look();
    std::filesystem::remove(folder.file("a"));
    EXPECT_FALSE(files.look());
    write("a", "one");
    EXPECT_FALSE(files.look());
    EXPECT_FALSE(files.look());
    EXPECT_EQ(files.text("a"), "one");
}

TEST_F(WatchedFilesTest, TellOfAFileThatStaysAway) {
    write("a", "one");
    files.watch("a", "one");
    files.look();
    files.look();
    std::filesystem::remove(folder.file("a"));
    EXPECT_FALSE(files.look());
    EXPECT_TRUE(files.look());
    EXPECT_EQ(files.text("a"), std::nullopt);
}

TEST_F(WatchedFilesTest, TakeNoNoticeOfATouch) {
    write("a", "one");
    files.watch("a", "one");
    files.look();
    files.look();
    write("a", "one");
    EXPECT_FALSE(files.look());
    EXPECT_FALSE(files.look());
}

TEST_F(WatchedFilesTest, ReadAndWatchAFileThatIsAskedFor) {
    EXPECT_EQ(files.text("a"), std::nullopt);
    write("a", "one");
    EXPECT_FALSE(files.look());
    EXPECT_TRUE(files.look());
    EXPECT_EQ(files.text("a"), "one");
}

}  // namespace
}  // namespace benchmarks::viewer
