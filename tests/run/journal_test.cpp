#include "benchmarks/run/record.h"

#include <filesystem>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/environment.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::run {
namespace {

// Returns a line as the file holds it.
std::string journalLine(const std::string& json) {
    return R"({"hash":")" + report::hashText(json) + R"(","line":)" + json + "}\n";
}

std::vector<scene::Json> linesOf(Journal& journal) {
    std::vector<scene::Json> lines;
    journal.read(
        [&](scene::Json line, const Journal::Place&) { lines.push_back(std::move(line)); });
    return lines;
}

class JournalFile : public testing::Test {
protected:
    // Returns the lines that another process reads.
    std::string found() {
        Journal journal(path_);
        return scene::Json(linesOf(journal)).dump();
    }
    void append(const std::string& json) {
        Journal journal(path_);
        linesOf(journal);
        journal.append(scene::Json::parse(json));
    }
    std::string error() {
        return folder_.relative(errorText([&] {
            Journal journal(path_);
            linesOf(journal);
        }));
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_.file("a/b/r.json.journal");
};

TEST_F(JournalFile, KeepsLines) {
    append(R"({"schema": "x"})");
    append(R"({"name": "two\nlines", "value": 0.1})");
    EXPECT_EQ(
        textOf(path_),
        journalLine(R"({"schema":"x"})") + journalLine(R"({"name":"two\nlines","value":0.1})"));
    EXPECT_EQ(found(), R"([{"schema":"x"},{"name":"two\nlines","value":0.1}])");
}

TEST_F(JournalFile, LosesOnlyTheLineThatWasCutShort) {
    append("[1]");
    append("[22]");
    append("[333]");
    const std::string whole = textOf(path_);
    const std::size_t first = journalLine("[1]").size();
    const std::size_t second = first + journalLine("[22]").size();
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        folder_.write("a/b/r.json.journal", whole.substr(0, size));
        const std::string expected = size < first          ? "[]"
                                     : size < second       ? "[[1]]"
                                     : size < whole.size() ? "[[1],[22]]"
                                                           : "[[1],[22],[333]]";
        EXPECT_EQ(found(), expected) << size;
        if (size == 0) continue;  // the file was empty
        append("[4]");
        EXPECT_EQ(
            textOf(path_).find(journalLine("[4]")), size < first          ? 0u
                                                    : size < second       ? first
                                                    : size < whole.size() ? second
                                                                          : whole.size());
    }
}

// Damage by a crash of the machine: blocks that were not written, flipped bits, and other programs'
// lines.
TEST_F(JournalFile, LosesOnlyTheLineThatIsDamaged) {
    std::string flipped = journalLine("[22]");
    flipped[flipped.find("22")] = '3';
    const std::string deep(100000, '[');
    for (const std::string& damaged :
         {std::string("\0\0\0\0\n", 5), std::string("\n"), std::string("null\n"),
          std::string("{}\n"), std::string("[2]\n"), flipped, deep + "\n", journalLine(deep),
          journalLine(deep + std::string(deep.size(), ']')), journalLine("{\"a\": 1, \"a\": 2}")}) {
        folder_.write("a/b/r.json.journal", journalLine("[1]") + damaged + journalLine("[3]"));
        EXPECT_EQ(found(), "[[1],[3]]") << damaged.substr(0, 40);
        append("[4]");
        Journal journal(path_);
        EXPECT_EQ(scene::Json(linesOf(journal)).dump(), "[[1],[3],[4]]");
        EXPECT_THAT(journal.damaged(), testing::ElementsAre(2));
    }
}

// The reader detects a flip of any bit of a line.
TEST_F(JournalFile, SeesEveryFlippedBit) {
    const std::string whole = journalLine(R"({"name":"a","value":0.25})");
    for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string flipped = whole;
            flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
            folder_.write("a/b/r.json.journal", journalLine("[1]") + flipped + journalLine("[3]"));
            EXPECT_EQ(found(), "[[1],[3]]") << flipped;
        }
    }
}

TEST_F(JournalFile, IsNotTakenForOne) {
    folder_.write("a/b/r.json.journal", "dear diary\n");
    EXPECT_EQ(error(), "a/b/r.json.journal: is not a journal of 'hairbench run'");
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
    linesOf(journal);
    journal.remove();
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(JournalFile, BeginsAnewAfterClear) {
    append("[1]");
    append("[2]");
    {
        Journal journal(path_);
        linesOf(journal);
        journal.clear();
        journal.append(scene::Json::parse("[3]"));
    }
    EXPECT_EQ(textOf(path_), journalLine("[3]"));
}

// Lines can be read again at the places that reading and writing report.
TEST_F(JournalFile, FindsEachLineAgain) {
    const std::string long_text(3 << 20, 'x');  // more than one read
    std::vector<Journal::Place> places;
    {
        Journal journal(path_);
        for (const char* line : {"[1]", "{\"a\":0.1}"})
            places.push_back(journal.append(scene::Json::parse(line)));
        places.push_back(journal.append(long_text));
        places.push_back(journal.append(4));
        EXPECT_EQ(journal.at(places[1]).dump(), "{\"a\":0.1}");
    }
    Journal journal(path_);
    std::size_t i = 0;
    journal.read([&](const scene::Json& line, const Journal::Place& place) {
        ASSERT_LT(i, places.size());
        EXPECT_EQ(place.begin, places[i].begin);
        EXPECT_EQ(place.size, places[i].size);
        EXPECT_EQ(journal.at(place), line);
        ++i;
    });
    EXPECT_EQ(i, 4u);
    EXPECT_EQ(journal.at(places[2]), long_text);
    std::filesystem::resize_file(path_, places[3].begin);
    EXPECT_EQ(
        folder_.relative(errorText([&] { journal.at(places[3]); })),
        "a/b/r.json.journal: was changed during the run");
}

TEST_F(JournalFile, SaysWhyItCannotBeOpened) {
    std::filesystem::create_directories(path_);
    EXPECT_EQ(error(), "a/b/r.json.journal: Is a directory");
}

}  // namespace
}  // namespace benchmarks::run
