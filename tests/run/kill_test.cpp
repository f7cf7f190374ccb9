// Tests kill -9 at any moment of a sweep, followed by --resume: only the case in progress is lost.
#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

using Seconds = std::chrono::duration<double>;

class Killed : public TinySweep {
protected:
    // Kills `kills` runs and completes each sweep in between.
    void killAndResume(int kills, std::uint32_t seed) {
        whole();
        const auto start = std::chrono::steady_clock::now();
        ASSERT_EQ(run(folder_.file("timed.json")).status, 0);
        const double duration = Seconds(std::chrono::steady_clock::now() - start).count();
        std::mt19937 random(seed);
        int done = 0;
        int early = 0;     // before the first case was done
        int finished = 0;  // after at least one case
        int between = 0;   // after the run's first case and before its last
        for (int sweep = 0; done < kills; ++sweep) {
            const std::filesystem::path out = folder_.file(std::to_string(sweep) + ".json");
            // One to four kills at any moment: before there is a journal, during a case, or between
            // two.
            for (std::uint32_t left = 1 + random() % 4; left > 0 && done < kills; --left) {
                const long before = journalled(out);
                ChildProcess process(arguments(out, {"--resume"}), log_);
                const double share = static_cast<double>(random() % 1000) / 1000.0;
                // Every other kill comes after the first case, within the time of two cases. The
                // others come at any moment, more often early, while a run starts, than late.
                const bool late = done % 2 == 0;
                if (late) waitForACase(out, duration);
                std::this_thread::sleep_for(
                    Seconds(late ? duration * share * 2.0 / kCases : duration * share * share));
                process.kill(SIGKILL);
                if (process.wait() != 128 + SIGKILL) break;  // the run was complete
                ++done;
                const long after = journalled(out);
                EXPECT_GE(after, before);  // nothing is lost
                if (after <= 0) ++early;
                if (after > 0) ++finished;
                if (after > before && after < static_cast<long>(kCases)) ++between;
            }
            const Outcome outcome = run(out, {"--resume"});
            ASSERT_EQ(outcome.status, 0) << outcome.output;
            EXPECT_EQ(difference(lasting(report::readReport(out)), whole()), "[]");
            EXPECT_FALSE(std::filesystem::exists(journalFile(out)));
            std::filesystem::remove(out);
        }
        std::cout << done << " kills: " << early << " before any case was done, " << finished
                  << " after one at least, " << between << " after more cases\n";
        EXPECT_GE(2 * finished, done);
    }

    // Waits at most ten times as long as a whole run takes.
    static void waitForACase(const std::filesystem::path& out, double duration) {
        const auto start = std::chrono::steady_clock::now();
        while (journalled(out) < 1 &&
               Seconds(std::chrono::steady_clock::now() - start).count() < 10.0 * duration)
            std::this_thread::sleep_for(Seconds(0.005));
    }
};

TEST_F(Killed, LosesNothing) { killAndResume(8, 1); }

// HAIRBENCH_KILLS=50 test_run --gtest_filter='Killed.*'
TEST_F(Killed, LosesNothingHoweverOften) {
    const char* const kills = std::getenv("HAIRBENCH_KILLS");
    if (!kills) GTEST_SKIP() << "HAIRBENCH_KILLS says how often";
    killAndResume(std::atoi(kills), 2);
}

}  // namespace
}  // namespace benchmarks::run
