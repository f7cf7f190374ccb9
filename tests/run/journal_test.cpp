#include "benchmarks/run/record.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

class JournalFile : public testing::Test {
protected:
    // The lines that another process finds.
    std::string found() {
        Journal journal(path_);
        return scene::Json(journal.read()).dump();
    }
    void append(const std::string& json) {
        Journal journal(path_);
        journal.read();
        journal.append(scene::Json::parse(json));
    }
    std::string error() {
        return folder_.relative(errorText([&] { Journal(path_).read(); }));
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_.file("a/b/r.json.journal");
};

TEST_F(JournalFile, KeepsLines) {
    append(R"({"schema": "x"})");
    append(R"({"name": "two\nlines", "value": 0.1})");
    EXPECT_EQ(textOf(path_), "{\"schema\":\"x\"}\n{\"name\":\"two\\nlines\",\"value\":0.1}\n");
    EXPECT_EQ(found(), R"([{"schema":"x"},{"name":"two\nlines","value":0.1}])");
}

TEST_F(JournalFile, LosesOnlyTheLineThatWasCutShort) {
    append("[1]");
    append("[22]");
    append("[333]");
    const std::string whole = textOf(path_);  // lines end behind bytes 4, 9 and 15
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        folder_.write("a/b/r.json.journal", whole.substr(0, size));
        const std::string expected = size < 4    ? "[]"
                                     : size < 9  ? "[[1]]"
                                     : size < 15 ? "[[1],[22]]"
                                                 : "[[1],[22],[333]]";
        EXPECT_EQ(found(), expected) << size;
        if (size == 0) continue;  // nothing was there
        append("[4]");
        EXPECT_EQ(
            textOf(path_).find("[4]\n"), size < 4    ? 0u
                                         : size < 9  ? 4u
                                         : size < 15 ? 9u
                                                     : 15u);
    }
}

// What a crash of the machine can leave of blocks that were not written.
TEST_F(JournalFile, EndsWhereItIsNoJson) {
    folder_.write("a/b/r.json.journal", std::string("[1]\n\0\0\0\0\n[3]\n", 13));
    EXPECT_EQ(found(), "[[1]]");
    append("[2]");
    EXPECT_EQ(textOf(path_), "[1]\n[2]\n");
}

TEST_F(JournalFile, IsNotTakenForOne) {
    folder_.write("a/b/r.json.journal", "dear diary\n");
    EXPECT_EQ(error(), "a/b/r.json.journal: is no journal of hairbench run");
    EXPECT_EQ(textOf(path_), "dear diary\n");
}

TEST_F(JournalFile, BelongsToOneProcess) {
    const Journal journal(path_);
    EXPECT_EQ(error(), "a/b/r.json.journal: another run is writing it");
}

TEST_F(JournalFile, IsNotLeftEmpty) {
    {
        const Journal journal(path_);
    }
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(JournalFile, GoesWhenItIsNotNeeded) {
    append("[1]");
    Journal journal(path_);
    journal.read();
    journal.remove();
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(JournalFile, BeginsAnewAfterClear) {
    append("[1]");
    append("[2]");
    {
        Journal journal(path_);
        journal.read();
        journal.clear();
        journal.append(scene::Json::parse("[3]"));
    }
    EXPECT_EQ(textOf(path_), "[3]\n");
}

TEST_F(JournalFile, SaysWhyItCannotBeOpened) {
    std::filesystem::create_directories(path_);
    EXPECT_EQ(error(), "a/b/r.json.journal: Is a directory");
}

}  // namespace
}  // namespace benchmarks::run
