// Tests a full disk: there is a clear error, and earlier results stay.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <sys/mount.h>

#include "tests/required.h"
#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

// Returns the last line of the program's output.
std::string lastLine(const std::string& output) {
    const std::size_t end = output.find_last_not_of('\n');
    return output.substr(output.rfind('\n', end) + 1, end - output.rfind('\n', end));
}

class FullDisk : public TinySweep {
protected:
    void SetUp() override {
        TinySweep::SetUp();
        if (isOver()) return;
        // Sizes in bytes, to choose limits by. The digits of times vary, but by less than the
        // limits allow.
        const fs::path out = folder_.file("sized.json");
        ASSERT_EQ(run(out, {"--no-pictures"}).status, 0);
        report_size_ = fs::file_size(out);
        const scene::Json report = report::readReport(out);
        for (const scene::Json& each : report["cases"]) cases_size_ += each.dump().size() + 1;
    }

    // A run that lacks room says so in one line, has status 1 and keeps some cases.
    void expectFailure(const Outcome& outcome, const fs::path& out, const char* reason) {
        EXPECT_EQ(outcome.status, 1) << outcome.output;
        const std::string line = lastLine(outcome.output);
        EXPECT_THAT(line, HasSubstr(journalFile(out).string() + ": cannot be written: " + reason));
        EXPECT_THAT(line, HasSubstr("--resume continues with "));
        const long kept = journalled(out);
        EXPECT_GT(kept, 0);
        EXPECT_LT(kept, static_cast<long>(kCases));
        EXPECT_THAT(line, HasSubstr("; " + std::to_string(kept) + " case"));
        EXPECT_THAT(textOf(journalFile(out)), EndsWith("}\n"));
        EXPECT_FALSE(fs::exists(out));
    }

    void expectWhole(const fs::path& out) {
        const Outcome outcome = run(out, {"--no-pictures", "--resume"});
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        scene::Json expected = whole();
        for (scene::Json& each : expected["cases"]) each.erase("picture");
        EXPECT_EQ(difference(lasting(report::readReport(out)), expected), "[]");
    }

    std::uintmax_t report_size_ = 0;
    std::uintmax_t cases_size_ = 0;  // in the journal
};

// A small file system in memory.
class SmallDisk {
public:
    SmallDisk(fs::path path, std::uintmax_t size) : path_(std::move(path)) {
        fs::create_directories(path_);
        const std::string options = "size=" + std::to_string(size);
        is_there_ = mount("none", path_.c_str(), "tmpfs", 0, options.c_str()) == 0;
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        if (is_there_) umount2(path_.c_str(), MNT_DETACH);
    }

    bool isThere() const { return is_there_; }
    bool grow() { return mount("none", path_.c_str(), "tmpfs", MS_REMOUNT, "size=16m") == 0; }

private:
    fs::path path_;
    bool is_there_;
};

// A limit on the size of files has the same effect and needs no right to mount. Newer lavapipe
// keeps its memory in a file: it refuses the run before there is a journal.
TEST_F(FullDisk, OfALimitedFileKeepsTheJournal) {
    const fs::path out = folder_.file("r.json");
    ChildProcess process(arguments(out, {"--no-pictures"}), log_, cases_size_);
    const int status = process.wait();
    if (const std::string text = textOf(log_);
        text.find("keeps its memory in a file") != std::string::npos) {
        EXPECT_EQ(status, 2) << text;
        EXPECT_THAT(lastLine(text), EndsWith("(ulimit -f 262144)"));
        EXPECT_FALSE(fs::exists(journalFile(out)));
    } else {
        expectFailure({status, text}, out, "File too large");
    }
    expectWhole(out);
}

// The report is the larger file, with one sample a line. A disk holds whole pages of 4 KiB.
TEST_F(FullDisk, ThatTakesTheJournalButNotTheReport) {
    SmallDisk disk(folder_.file("disk"), report_size_);
    if (!disk.isThere())
        GTEST_SKIP() << "no file system can be mounted here: " << std::strerror(errno);
    const fs::path out = folder_.file("disk/r.json");
    const Outcome outcome = run(out, {"--no-pictures"});
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_EQ(journalled(out), static_cast<long>(kCases));
    const std::string line = lastLine(outcome.output);
    EXPECT_THAT(
        line,
        HasSubstr(out.string() + ": cannot be written: No space left on device; all is kept in "));
    EXPECT_THAT(line, EndsWith("r.json.journal: --resume writes the report"));
    EXPECT_FALSE(fs::exists(out));
    ASSERT_TRUE(disk.grow());
    expectWhole(out);
}

TEST_F(FullDisk, KeepsTheJournal) {
    // The disk has room for the journal's header and some cases.
    SmallDisk disk(folder_.file("disk"), cases_size_);
    if (!disk.isThere())
        GTEST_SKIP() << "no file system can be mounted here: " << std::strerror(errno);
    const fs::path out = folder_.file("disk/r.json");
    expectFailure(run(out, {"--no-pictures"}), out, "No space left on device");
    // A second try: nothing more fits, and nothing is lost.
    const std::string journal = textOf(journalFile(out));
    expectFailure(run(out, {"--no-pictures", "--resume"}), out, "No space left on device");
    EXPECT_EQ(textOf(journalFile(out)), journal);
    ASSERT_TRUE(disk.grow());
    expectWhole(out);
}

}  // namespace
}  // namespace benchmarks::run
