#include "benchmarks/viewer/studio.h"

#include <algorithm>
#include <array>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

using namespace std::chrono_literals;

// Far longer than a busy machine needs; anything longer hangs.
constexpr auto kHangs = 60s;

// A value with equal members, so that a partial write would be visible.
struct Whole {
    std::array<std::uint64_t, 64> copies{};

    static Whole of(std::uint64_t value) {
        Whole whole;
        whole.copies.fill(value);
        return whole;
    }
    bool isWhole() const {
        for (const std::uint64_t copy : copies)
            if (copy != copies.front()) return false;
        return true;
    }
};

// Work that waits until it is released.
struct Held {
    std::binary_semaphore begun{0};
    std::binary_semaphore let_go{0};
};

TEST(WorkerThread, AnswersEachOrderOnce) {
    std::counting_semaphore<> told(0);
    WorkerThread<int, int> thread(
        [](int order, const Stop&) { return order * order; }, [&] { told.release(); });
    EXPECT_FALSE(thread.busy());
    EXPECT_FALSE(thread.take());
    for (int i = 0; i < 100; ++i) {
        thread.begin(i);
        EXPECT_TRUE(thread.busy());
        told.acquire();  // signalled for every reply
        EXPECT_TRUE(thread.waitFor(kHangs));
        EXPECT_EQ(thread.take(), i * i);
        EXPECT_FALSE(thread.busy());
        EXPECT_FALSE(thread.take());
    }
    EXPECT_FALSE(told.try_acquire());
}

// The ordering thread continues while the latch is closed: it does not wait for the work.
TEST(WorkerThread, LeavesWhoeverGivesOrdersFreeMeanwhile) {
    Held held;
    WorkerThread<int, int> thread(
        [&](int order, const Stop&) {
            held.begun.release();
            held.let_go.acquire();
            return order;
        },
        [] {});
    thread.begin(7);
    held.begun.acquire();
    for (int i = 0; i < 1000; ++i) {
        EXPECT_TRUE(thread.busy());
        EXPECT_FALSE(thread.take());
        EXPECT_FALSE(thread.waitFor(0us));
    }
    held.let_go.release();
    EXPECT_TRUE(thread.waitFor(kHangs));
    EXPECT_EQ(thread.take(), 7);
}

// Changes during an order go into the next one, completely and in their latest state.
TEST(WorkerThread, LosesNoLastValueAndShowsNoneByHalf) {
    constexpr std::uint64_t kValues = 20000;
    std::vector<std::uint64_t> seen;
    bool whole = true;
    WorkerThread<Whole, Whole> thread(
        [&](const Whole& order, const Stop&) {
            whole = whole && order.isWhole();
            seen.push_back(order.copies.front());
            return order;
        },
        [] {});
    std::uint64_t answered = 0;
    Whole wanted = Whole::of(0);
    for (std::uint64_t value = 1; value <= kValues; ++value) {
        wanted = Whole::of(value);  // like a dragged slider
        if (const auto reply = thread.take()) {
            EXPECT_TRUE(reply->isWhole());
            answered = reply->copies.front();
        }
        if (!thread.busy()) thread.begin(wanted);
    }
    while (answered != kValues) {
        if (!thread.busy()) thread.begin(wanted);
        ASSERT_TRUE(thread.waitFor(kHangs));
        const auto reply = thread.take();
        ASSERT_TRUE(reply.has_value());
        EXPECT_TRUE(reply->isWhole());
        answered = reply->copies.front();
    }
    EXPECT_TRUE(whole);
    EXPECT_EQ(seen.back(), kValues);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
}

TEST(WorkerThread, HandsErrorsOverAndGoesOn) {
    WorkerThread<int, int> thread(
        [](int order, const Stop&) {
            if (order < 0) throw std::runtime_error("the device was lost");
            return order;
        },
        [] {});
    thread.begin(-1);
    ASSERT_TRUE(thread.waitFor(kHangs));
    EXPECT_THROW(thread.take(), std::runtime_error);
    EXPECT_FALSE(thread.busy());
    thread.begin(3);
    ASSERT_TRUE(thread.waitFor(kHangs));
    EXPECT_EQ(thread.take(), 3);
}

TEST(WorkerThread, EndsWorkThatLooksWhetherItIsToStop) {
    Held held;
    WorkerThread<int, std::string> thread(
        [&](int, const Stop& stop) -> std::string {
            held.begun.release();
            while (!stop()) std::this_thread::yield();
            return "stopped";
        },
        [] {});
    thread.begin(1);
    held.begun.acquire();
    thread.requestStop();
    ASSERT_TRUE(thread.waitFor(kHangs));
    EXPECT_EQ(thread.take(), "stopped");
}

// A thread without an order ends too, and so does one with a reply that is never taken.
TEST(WorkerThread, EndsWithoutAnOrderAndWithAReplyThatIsLeft) {
    {
        WorkerThread<int, int> thread([](int order, const Stop&) { return order; }, [] {});
    }
    WorkerThread<int, int> thread([](int order, const Stop&) { return order; }, [] {});
    thread.begin(1);
    EXPECT_TRUE(thread.waitFor(kHangs));
}

}  // namespace
}  // namespace benchmarks::viewer
