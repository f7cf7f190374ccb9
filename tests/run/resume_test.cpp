// Tests runs that end early and are resumed.
#include <chrono>
#include <thread>

#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

using testing::HasSubstr;

class Resume : public TinySweep {
protected:
    // Runs and presses Ctrl-C between the first and the last case. On a busy machine it may come
    // too late; then it tries again.
    void interrupt(const std::filesystem::path& out) {
        for (int attempt = 0; attempt < 20; ++attempt) {
            ChildProcess process(arguments(out), log_);
            while (journalled(out) < 1 && textOf(log_).find("report: ") == std::string::npos)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            process.kill(SIGINT);
            if (process.wait() == 130) return;
            std::filesystem::remove(out);
        }
        FAIL() << "no run was interrupted";
    }

    std::filesystem::path out_ = folder_.file("r.json");
};

TEST_F(Resume, GoesOnAfterAnInterrupt) {
    interrupt(out_);
    const scene::Json partial = report::readReport(out_);
    EXPECT_EQ(partial["interrupted"], true);
    EXPECT_LT(partial["cases"].size(), kCases);
    EXPECT_EQ(static_cast<long>(partial["cases"].size()), journalled(out_));
    EXPECT_THAT(textOf(log_), HasSubstr("--resume continues"));

    const Outcome outcome = run(out_, {"--resume"});
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output, HasSubstr(
                            "continuing after " + std::to_string(partial["cases"].size()) + " of " +
                            std::to_string(kCases) + " cases"));
    const scene::Json report = report::readReport(out_);
    EXPECT_EQ(difference(lasting(report), whole()), "[]");
    EXPECT_EQ(difference(report["environment"], partial["environment"]), "[]");
    // Earlier measurements are unchanged.
    for (const scene::Json& before : partial["cases"])
        EXPECT_EQ(difference(report["cases"][before["index"].get<std::size_t>()], before), "[]");
    EXPECT_FALSE(std::filesystem::exists(journalFile(out_)));
}

TEST_F(Resume, OfACompleteRunDoesNothing) {
    ASSERT_EQ(run(out_).status, 0);
    const std::string before = textOf(out_);
    const Outcome outcome = run(out_, {"--resume"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, HasSubstr("nothing left to do"));
    EXPECT_EQ(textOf(out_), before);
}

TEST_F(Resume, OfNothingIsARun) {
    EXPECT_EQ(run(out_, {"--resume"}).status, 0);
    EXPECT_EQ(difference(lasting(report::readReport(out_)), whole()), "[]");
}

TEST_F(Resume, RefusesAnotherSweep) {
    interrupt(out_);
    const std::string journal = textOf(journalFile(out_));
    const Outcome other = run(out_, {"--resume", "-a", "/strands/density=1,2,3,4,5,7"});
    EXPECT_EQ(other.status, 2);
    EXPECT_THAT(other.output, HasSubstr("r.json.journal: can't be resumed: its cases differ\n"));
    const Outcome frames = run(out_, {"--resume", "--frames", "3"});
    EXPECT_EQ(frames.status, 2);
    EXPECT_THAT(frames.output, HasSubstr("can't be resumed: hash of the scene: "));
    const Outcome anew = run(out_);
    EXPECT_EQ(anew.status, 2);
    EXPECT_THAT(anew.output, HasSubstr("of a run that was not finished: --resume continues it"));
    EXPECT_EQ(textOf(journalFile(out_)), journal);
}

TEST_F(Resume, GoesOnFromAnyByteOfAJournal) {
    interrupt(out_);
    const std::string journal = textOf(journalFile(out_));
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, journal.find('\n') + 1, journal.size() / 2,
          journal.size() - 1}) {
        const std::filesystem::path out = folder_.file(std::to_string(size) + ".json");
        folder_.write(std::to_string(size) + ".json.journal", journal.substr(0, size));
        const Outcome outcome = run(out, {"--resume"});
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(difference(lasting(report::readReport(out)), whole()), "[]") << size;
    }
}

}  // namespace
}  // namespace benchmarks::run
