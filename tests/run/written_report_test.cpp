// Tests the files of a real run.
#include <set>

#include <sys/stat.h>

#include "benchmarks/doctor/reports.h"
#include "benchmarks/scene/json.h"
#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class WrittenReport : public TinySweep {
protected:
    static std::string schema() {
        return textOf(std::filesystem::path(HAIRBENCH_SOURCE_DIR) / "results/report.schema.json");
    }
    // Returns the report of a run of the smoke scene, which must succeed.
    scene::Json smoke(const std::string& options) {
        const Outcome outcome = hairbench(
            "run '" HAIRBENCH_SCENES_DIR "/smoke.json' " + options + " -o '" + out_.string() + "'");
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return scene::Json::parse(textOf(out_));
    }

    std::filesystem::path out_ = folder_.file("smoke.json");
};

TEST_F(WrittenReport, FitsTheSchema) {
    smoke("");
    EXPECT_THAT(report::schemaErrors(schema(), textOf(out_)), IsEmpty());
    // Unknown values are left out.
    EXPECT_THAT(textOf(out_), testing::Not(HasSubstr("null")));
}

// Checks that the other tests compare something: hair is visible, and each case has a different
// picture.
TEST_F(WrittenReport, DiffersFromCaseToCase) {
    std::set<std::string> images;
    const scene::Json report = whole();
    for (const scene::Json& each : report["cases"])
        if (each["status"] == "ok") images.insert(each["image_hash"].get<std::string>());
    EXPECT_GE(images.size(), 6u);
}

TEST_F(WrittenReport, FitsTheSchemaWhateverBecameOfCases) {
    ASSERT_EQ(run(out_).status, 0);
    EXPECT_THAT(report::schemaErrors(schema(), textOf(out_)), IsEmpty());
}

TEST_F(WrittenReport, HasItsPicturesBesideIt) {
    const scene::Json report = smoke("");
    std::set<std::string> pictures;
    for (const scene::Json& each : report["cases"]) {
        const auto picture = each["picture"].get<std::string>();
        EXPECT_EQ(picture, "smoke.pictures/" + each["index"].dump() + ".png");
        EXPECT_TRUE(std::filesystem::is_regular_file(folder_.file(picture)));
        pictures.insert(picture);
    }
    EXPECT_EQ(pictures.size(), report["cases"].size());
    folder_.write("smoke.pictures/mine.png", "");
    smoke("-a /render/msaa=1");  // removes pictures of former cases
    EXPECT_TRUE(std::filesystem::exists(folder_.file("smoke.pictures/0.png")));
    EXPECT_FALSE(std::filesystem::exists(folder_.file("smoke.pictures/1.png")));
    EXPECT_TRUE(std::filesystem::exists(folder_.file("smoke.pictures/mine.png")));
}

TEST_F(WrittenReport, HasNoPicturesWhereNoneAreWanted) {
    const scene::Json report = smoke("--no-pictures");
    for (const scene::Json& each : report["cases"]) EXPECT_FALSE(each.contains("picture"));
    EXPECT_FALSE(std::filesystem::exists(folder_.file("smoke.pictures")));
}

// Drivers of software devices tell nothing of their code, and it isn't missed.
TEST_F(WrittenReport, HasNoCostsOfShadersThatNobodyTells) {
    if (hairbench("shaders '" HAIRBENCH_SCENES_DIR "/smoke.json' -o '" + out_.string() + "'")
            .status == 0)
        GTEST_SKIP() << "the driver tells them";
    const scene::Json report = smoke("");
    for (const scene::Json& each : report["cases"]) {
        EXPECT_FALSE(each.contains("shaders"));
        for (const auto& [name, metric] : each["metrics"].items())
            EXPECT_FALSE(name.starts_with("shader."));
        EXPECT_THAT(each["trust"]["warnings"].dump(), testing::Not(HasSubstr("shader")));
    }
}

TEST_F(WrittenReport, MovesManySamplesIntoAFileOfTheirOwn) {
    smoke("-a /render/msaa=1 --frames 2001 --set /render/width=32 --set /render/height=32 "
          "--set /groom/guides=4 --set /render/hair=false --set /render/head=false");
    EXPECT_THAT(report::schemaErrors(schema(), textOf(out_)), IsEmpty());
    EXPECT_TRUE(std::filesystem::exists(folder_.file("smoke.samples.jsonl")));
    const scene::Json report = report::readReport(out_);
    EXPECT_GE(report["cases"][0]["metrics"]["frame.time"]["samples"].size(), 2001u);
}

TEST_F(WrittenReport, GoesWhereThereIsNoFile) {
    const Outcome outcome = runInShell(
        "'" HAIRBENCH_PROGRAM "' run '" + scene_.string() + "' -o /dev/stdout 2>/dev/null");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, testing::StartsWith("{\n  \"schema\": \"hairbench-report/1."));
    EXPECT_FALSE(std::filesystem::exists("/dev/stdout.journal"));
}

// A file that the shell has opened must not be replaced, and no file is written beside it.
TEST_F(WrittenReport, GoesIntoAFileThatIsOpen) {
    const std::filesystem::path out = folder_.file("shell.txt");
    const Outcome outcome = runInShell(
        "{ echo before; '" HAIRBENCH_PROGRAM "' run '" + scene_.string() +
        "' -o /dev/stdout; } 2>&1 >'" + out.string() + "'");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output, testing::HasSubstr("/dev/stdout is not a file: this run has no journal"));
    EXPECT_THAT(textOf(out), testing::StartsWith("before\n{\n  \"schema\""));
    EXPECT_FALSE(std::filesystem::exists("/dev/stdout.journal"));
    EXPECT_FALSE(std::filesystem::exists("/dev/stdout.pictures"));
}

TEST_F(WrittenReport, KeepsItsJournalWhereNoLinkLeads) {
    const std::filesystem::path mine = folder_.write("mine.txt", "");
    std::filesystem::create_symlink("mine.txt", out_.string() + ".journal");
    const Outcome outcome = runInShell(
        "'" HAIRBENCH_PROGRAM "' run '" + scene_.string() + "' -o '" + out_.string() + "' 2>&1");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, testing::HasSubstr("is a link"));
    EXPECT_EQ(textOf(mine), "");
}

TEST_F(WrittenReport, KeepsItsJournalInNoPipe) {
    ASSERT_EQ(mkfifo((out_.string() + ".journal").c_str(), 0600), 0);
    for (const char* option : {"", " --resume"}) {
        const Outcome outcome = runInShell(
            "'" HAIRBENCH_PROGRAM "' run '" + scene_.string() + "' -o '" + out_.string() + "'" +
            option + " 2>&1");
        EXPECT_EQ(outcome.status, 2);
        EXPECT_THAT(outcome.output, testing::HasSubstr("is not a file"));
    }
}

}  // namespace
}  // namespace benchmarks::run
