// Effects of an interrupt, and the texts of steps in progress. An interrupted process stays
// interrupted, so each test has its own.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/process.h"
#include "tests/temporary_folder.h"

namespace engine {
namespace {

using namespace std::chrono_literals;

class Interrupts : public testing::Test {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

    // Waits for a device that never finishes.
    [[noreturn]] static void waitForEver() {
        waitInterruptibly([](std::uint64_t nanoseconds) {
            std::this_thread::sleep_for(std::chrono::nanoseconds(nanoseconds));
            return false;
        });
        std::_Exit(1);
    }
    static void interrupt() {
        catchInterrupts();
        std::raise(SIGTERM);
    }
};

TEST_F(Interrupts, EndAWaitForTheDeviceWithLastWords) {
    const TemporaryFolder folder;
    const std::filesystem::path left = folder.file("left");
    EXPECT_EXIT(
        {
            const Leftover leftover(left);
            std::ofstream(left) << "half";
            const InterruptMessage outer([] { std::cerr << "outer\n"; });
            const InterruptMessage inner([] { std::cerr << "inner\n"; });
            interrupt();
            waitForEver();
        },
        testing::ExitedWithCode(130), "inner\nouter\n");
    EXPECT_FALSE(std::filesystem::exists(left));
}

TEST_F(Interrupts, LetADeviceThatIsNearlyDoneFinish) {
    EXPECT_EXIT(
        {
            interrupt();
            int waits = 0;
            waitInterruptibly([&](std::uint64_t) { return ++waits > 2; });
            std::_Exit(interrupted() ? 7 : 1);
        },
        testing::ExitedWithCode(7), "");
}

TEST_F(Interrupts, SayWhatWentWrongWithLastWords) {
    EXPECT_EXIT(
        {
            const InterruptMessage words([] { throw std::runtime_error("the disk is full"); });
            interrupt();
            waitForEver();
        },
        testing::ExitedWithCode(1), "the disk is full");
}

TEST_F(Interrupts, EndWhatNeverAsks) {
    EXPECT_EXIT(
        {
            interrupt();
            for (;;) pause();
        },
        testing::ExitedWithCode(130), "interrupted\n");
}

TEST_F(Interrupts, EndWhatNeverAsksWithLastWords) {
    EXPECT_EXIT(
        {
            const InterruptMessage words([] {
                checkInterrupted();  // last words may use work that asks
                std::cerr << "the report\n";
            });
            interrupt();
            for (;;) pause();
        },
        testing::ExitedWithCode(130), "the report\n");
}

TEST_F(Interrupts, LetChangesEndBeforeLastWords) {
    EXPECT_EXIT(
        {
            int done = 0;
            const InterruptMessage words([&] { std::cerr << done << " are done\n"; });
            interrupt();
            {
                const HeldMessages held;
                const HeldMessages nested;
                done = 1;
                std::this_thread::sleep_for(2s);  // longer than the program waits for who asks
                done = 2;
            }
            for (;;) pause();
        },
        testing::ExitedWithCode(130), "2 are done\n");
}

// Otherwise the work would end the program before the last words are complete.
TEST_F(Interrupts, HoldWorkThatAsksDuringLastWords) {
    EXPECT_EXIT(
        {
            std::atomic<bool> speaks = false;
            const InterruptMessage words([&] {
                speaks = true;
                std::this_thread::sleep_for(200ms);
                std::cerr << "the report\n";
            });
            interrupt();
            while (!speaks) std::this_thread::sleep_for(1ms);
            std::_Exit(interrupted() ? 7 : 8);
        },
        testing::ExitedWithCode(130), "the report\n");
}

TEST_F(Interrupts, DoNotEndWhatFinishesInAnyCase) {
    EXPECT_EXIT(
        {
            const InterruptMessage words([] { std::cerr << "interrupted\n"; });
            finishInAnyCase();
            interrupt();
            std::this_thread::sleep_for(2s);  // stands for writing results
            std::_Exit(7);
        },
        testing::ExitedWithCode(7), "^$");
}

TEST_F(Interrupts, LeaveTheEndToWhoAsked) {
    EXPECT_EXIT(
        {
            interrupt();
            try {
                checkInterrupted();
            } catch (const Interrupted&) {
                std::this_thread::sleep_for(2s);  // stands for writing results
                std::_Exit(7);
            }
        },
        testing::ExitedWithCode(7), "");
}

TEST_F(Interrupts, EndAStepThatAdvances) {
    EXPECT_EXIT(
        {
            Step step("walks", 3);
            step.advance();
            interrupt();
            try {
                step.advance();
            } catch (const Interrupted&) {
                std::_Exit(7);
            }
        },
        testing::ExitedWithCode(7), "");
}

TEST(Steps, AreThoseUnderWayOutermostFirst) {
    EXPECT_EQ(stepsUnderWay().text, "");
    int ends = 0;
    onceStepsEnd([&] { ++ends; });
    {
        std::string words = "case 1";
        const Step outer([&] { return words; });
        EXPECT_EQ(stepsUnderWay().start, outer.start());
        {
            Step inner("grows strands", 100);
            inner.advance(30);
            EXPECT_EQ(stepsUnderWay().text, "case 1  grows strands, 30 of 100");
            inner.advance(100);  // more than expected
            EXPECT_EQ(stepsUnderWay().text, "case 1  grows strands, 100 of 100");
        }
        words = "case 2";
        EXPECT_EQ(stepsUnderWay().text, "case 2");
        EXPECT_EQ(ends, 0);
        const Step reads("reads a.hair");
        EXPECT_EQ(stepsUnderWay().text, "case 2  reads a.hair");
    }
    EXPECT_EQ(stepsUnderWay().text, "");
    EXPECT_EQ(ends, 1);
    onceStepsEnd({});
}

TEST(Steps, CountWhatAllThreadsDo) {
    Step step("walks", 2000);
    const auto walk = [&] {
        for (int i = 0; i < 1000; ++i) step.advance();
    };
    std::thread other(walk);
    walk();
    other.join();
    EXPECT_EQ(step.text(), "walks, 2000 of 2000");
}

}  // namespace
}  // namespace engine
