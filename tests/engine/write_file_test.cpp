#include "engine/files.h"

#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> namesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

// Returns the file that is still being written.
fs::path partialIn(const fs::path& folder) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".partial") return entry.path();
    return {};
}

// Writes 64 MiB, unless the poll or the disk stops it, as blocks or as single numbers.
enum class Writes { blocks, numbers };

void writeMuch(std::ostream& out, Writes how) {
    const std::string block(1 << 20, 'x');
    for (int i = 0; i < 64; ++i) {
        if (how == Writes::blocks)
            out.write(block.data(), static_cast<std::streamsize>(1 << 20));
        else
            for (int k = 0; k < (1 << 17); ++k) out << 1000000 + k << '\n';
    }
}

class WriteMuch : public testing::TestWithParam<Writes> {
protected:
    TemporaryFolder folder_;
};

TEST(WriteFile, WritesAFileAndItsFolder) {
    const TemporaryFolder folder;
    const fs::path path = folder.file("a/b/new.txt");
    engine::writeFileAtomically(path, "text");
    EXPECT_EQ(textOf(path), "text");
    EXPECT_THAT(namesIn(path.parent_path()), ElementsAre("new.txt"));
}

TEST(WriteFile, ReplacesAFileAndKeepsItsPermissions) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("old.txt", "old and longer");
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    engine::writeFileAtomically(path, "new");
    EXPECT_EQ(textOf(path), "new");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(WriteFile, FollowsALink) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("real.txt", "old");
    const fs::path link = folder.file("link.txt");
    fs::create_symlink("real.txt", link);
    engine::writeFileAtomically(link, "new");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(textOf(path), "new");
}

// Another user of the folder could put a link under a name that can be guessed.
TEST(WriteFile, WritesThroughNoLinkThatLiesInItsWay) {
    const TemporaryFolder folder;
    const fs::path private_file = folder.write("private.txt", "mine");
    for (const char* name : {"new.txt.partial", "new.txt.0.partial", ".new.txt.partial"})
        fs::create_symlink("private.txt", folder.file(name));
    std::set<std::string> partials;
    for (int i = 0; i < 2; ++i)
        engine::writeFileAtomically(folder.file("new.txt"), [&](std::ostream& out) {
            for (const std::string& name : namesIn(folder.path()))
                if (!fs::is_symlink(folder.file(name)) && name.ends_with(".partial"))
                    partials.insert(name);
            out << "new";
        });
    EXPECT_EQ(textOf(private_file), "mine");
    EXPECT_EQ(textOf(folder.file("new.txt")), "new");
    EXPECT_EQ(partials.size(), 2u);  // a new name each time
}

TEST(WriteFile, IsWrittenByManyAtATime) {
    const TemporaryFolder folder;
    const fs::path path = folder.file("a.txt");
    std::vector<std::string> errors(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < errors.size(); ++i)
        threads.emplace_back([&, i] {
            for (int k = 0; k < 50; ++k) {
                const auto write = [&] {
                    engine::writeFileAtomically(path, std::string(1000, 'x'));
                };
                if (errorText(write) != "no error") errors[i] = errorText(write);
            }
        });
    for (std::thread& each : threads) each.join();
    EXPECT_THAT(errors, testing::Each(""));
    EXPECT_EQ(textOf(path), std::string(1000, 'x'));
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("a.txt"));
}

// A shell's "> file" and ">> file" open the file before the program writes on.
TEST(WriteFile, WritesOnWhatIsOpenAlready) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("log.txt", "before ");
    const int file = open(path.c_str(), O_WRONLY | O_APPEND);
    ASSERT_GE(file, 0);
    const fs::path name = "/dev/fd/" + std::to_string(file);
    fs::create_symlink(name, folder.file("link"));
    EXPECT_FALSE(engine::isReplaceable(name));
    EXPECT_FALSE(engine::isReplaceable(folder.file("link")));
    EXPECT_TRUE(engine::isReplaceable(path));
    engine::writeFileAtomically(name, "and ");
    engine::writeFileAtomically(folder.file("link"), "after");
    EXPECT_EQ(write(file, ".", 1), 1);
    close(file);
    EXPECT_EQ(textOf(path), "before and after.");
}

TEST(ReadFile, SaysHowLargeAFileMayBe) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("a.txt", std::string((1 << 16) + 1, 'x'));
    EXPECT_EQ(
        errorText([&] { engine::readFile(path, 1 << 16); }),
        path.string() + ": is larger than 64 KiB");
}

TEST(WriteFile, LeavesTheOldFileWhereTheWriterFails) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("file.txt", "old");
    const std::string error = errorText([&] {
        engine::writeFileAtomically(path, [](std::ostream& out) {
            out << "half";
            throw engine::Error("no more");
        });
    });
    EXPECT_EQ(error, "no more");
    EXPECT_EQ(textOf(path), "old");
    EXPECT_THAT(namesIn(folder.path()), ElementsAre("file.txt"));
}

TEST_P(WriteMuch, StopsWithinAMegabyteWhereThePollThrows) {
    struct Stop {};
    const fs::path path = folder_.write("file.txt", "old");
    std::uintmax_t seen = 0;
    const auto poll = [&] {
        seen = fs::file_size(partialIn(folder_.path()));
        if (seen > 3'000'000) throw Stop();
    };
    EXPECT_THROW(
        engine::writeFileAtomically(
            path, [](std::ostream& out) { writeMuch(out, GetParam()); }, poll),
        Stop);
    // One piece of at most 2^20 bytes, and less than that in the stream's buffer.
    EXPECT_LT(seen, 3'000'000u + 2u * (1u << 20));
    EXPECT_EQ(textOf(path), "old");
    EXPECT_THAT(namesIn(folder_.path()), ElementsAre("file.txt"));
}

TEST_P(WriteMuch, SaysThatTheDiskIsFull) {
    const std::string error = errorText([] {
        engine::writeFileAtomically(
            "/dev/full", [](std::ostream& out) { writeMuch(out, GetParam()); });
    });
    EXPECT_EQ(error, "/dev/full: cannot be written: No space left on device");
}

// A file size limit simulates a disk that fills up during writing.
TEST_P(WriteMuch, LeavesNothingWhereThereIsNoRoomForAll) {
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit low{.rlim_cur = 5'000'000, .rlim_max = before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
    const fs::path path = folder_.write("file.txt", "old");
    const std::string error = errorText([&] {
        engine::writeFileAtomically(path, [](std::ostream& out) { writeMuch(out, GetParam()); });
    });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, ignored);
    EXPECT_EQ(error, path.string() + ": cannot be written: File too large");
    EXPECT_EQ(textOf(path), "old");
    EXPECT_THAT(namesIn(folder_.path()), ElementsAre("file.txt"));
}

INSTANTIATE_TEST_SUITE_P(
    , WriteMuch, testing::Values(Writes::blocks, Writes::numbers),
    [](const auto& each) { return each.param == Writes::blocks ? "Blocks" : "Numbers"; });

TEST(WriteFile, RefusesAFolder) {
    const TemporaryFolder folder;
    const auto write = [&] { engine::writeFileAtomically(folder.path(), "text"); };
    EXPECT_THAT(errorText(write), HasSubstr("is a folder"));
    const auto check = [&] { engine::checkWritable(folder.path()); };
    EXPECT_THAT(errorText(check), HasSubstr("is a folder"));
}

// Opening a pipe would wait for its reader, but a pipe opened by the shell already has one.
TEST(WriteFile, RefusesAPipeByName) {
    const TemporaryFolder folder;
    const fs::path pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    fs::create_symlink("pipe", folder.file("link"));
    for (const fs::path& path : {pipe, folder.file("link")}) {
        EXPECT_THAT(errorText([&] { engine::checkWritable(path); }), HasSubstr("is a pipe"));
        EXPECT_THAT(
            errorText([&] { engine::writeFileAtomically(path, "text"); }), HasSubstr("is a pipe"));
    }
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const std::string open_one = "/dev/fd/" + std::to_string(ends[1]);
    engine::checkWritable(open_one);
    engine::writeFileAtomically(open_one, "text");
    char text[5] = {};
    EXPECT_EQ(read(ends[0], text, 4), 4);
    EXPECT_STREQ(text, "text");
    close(ends[0]);
    close(ends[1]);
}

TEST(WriteFile, RefusesLinksInACircleAndLongNames) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder.file("a"));
    fs::create_symlink("a", folder.file("b"));
    for (const fs::path& path :
         {folder.file("a"), folder.file("a/x.json"), folder.file(std::string(300, 'n')),
          folder.file(std::string(5000, 'n'))}) {
        EXPECT_NE(errorText([&] { engine::checkWritable(path); }), "no error") << path;
        EXPECT_NE(errorText([&] { engine::writeFileAtomically(path, "text"); }), "no error")
            << path;
    }
}

TEST(WriteFile, RefusesAFolderThatIsAFile) {
    const TemporaryFolder folder;
    folder.write("file", "");
    const auto check = [&] { engine::checkWritable(folder.file("file/in.txt")); };
    EXPECT_THAT(errorText(check), HasSubstr("file: cannot be made"));
}

}  // namespace
