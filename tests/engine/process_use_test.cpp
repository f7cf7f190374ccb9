#include "engine/process.h"

#include <atomic>
#include <thread>
#include <vector>

#include <linux/perf_event.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "engine/system/process.h"

namespace engine {
namespace {

TEST(ProcessUse, AddsAndSubtracts) {
    const ProcessUse a{5.0, 100.0};
    const ProcessUse b{2.0, 30.0};
    EXPECT_EQ((a + b).cpu, 7.0);
    EXPECT_EQ((a + b).instructions, 130.0);
    EXPECT_EQ((a - b).cpu, 3.0);
    EXPECT_EQ((a - b).instructions, 70.0);
    EXPECT_EQ((a - ProcessUse{1.0, {}}).instructions, std::nullopt);
    EXPECT_EQ((ProcessUse{1.0, {}} + a).instructions, std::nullopt);
}

// Works until the process has used 5 ms. If the clock did not count the other thread's work, this
// would never end.
TEST(ProcessUse, IsThatOfAllThreads) {
    const ProcessUse before = processUse();
    std::atomic<bool> stop = false;
    std::thread other([&] {
        while (!stop) {
        }
    });
    while ((processUse() - before).cpu < 5.0) std::this_thread::yield();
    stop = true;
    other.join();
    const ProcessUse used = processUse() - before;
    EXPECT_GE(used.cpu, 5.0);
    if (used.instructions) {
        EXPECT_GT(*used.instructions, 0.0);
    }
}

// Page faults replace instructions, because they are counted on machines without access to hardware
// counters. Everything else is equal. The first write to a new page is one fault.
constexpr std::size_t kPages = 200;

void touchPages() {
    const auto page_size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    void* const pages = mmap(
        nullptr, kPages * page_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(pages, MAP_FAILED);
    madvise(pages, kPages * page_size, MADV_NOHUGEPAGE);
    for (std::size_t i = 0; i < kPages; ++i) static_cast<volatile char*>(pages)[i * page_size] = 1;
    munmap(pages, kPages * page_size);
}

class PerfCounterTest : public testing::Test {
protected:
    void SetUp() override {
        if (!counter_.read()) GTEST_SKIP() << "the kernel counts no page faults for us";
    }
    double count() const { return counter_.read().value_or(-1.0); }

    system::PerfCounter counter_{{PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS}};
};

TEST_F(PerfCounterTest, CountsTheThreadThatMadeIt) {
    const double before = count();
    touchPages();
    EXPECT_GE(count() - before, double{kPages});
}

TEST_F(PerfCounterTest, CountsThreadsThatStillRunAndThreadsThatEnded) {
    const double before = count();
    std::atomic<bool> touched = false;
    std::atomic<bool> stop = false;
    std::thread other([&] {
        touchPages();
        touched = true;
        while (!stop) std::this_thread::yield();
    });
    while (!touched) std::this_thread::yield();
    EXPECT_GE(count() - before, double{kPages});
    stop = true;
    other.join();
    EXPECT_GE(count() - before, double{kPages});
}

TEST_F(PerfCounterTest, CountsThreadsOfThreads) {
    const double before = count();
    std::thread([] { std::thread(touchPages).join(); }).join();
    EXPECT_GE(count() - before, double{kPages});
}

// A higher value is a lower priority.
int niceness() { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); }

TEST(GiveWay, IsForAThreadAndThoseThatItStarts) {
    const int before = niceness();
    int of_thread = before, of_its_own = before;
    std::thread([&] {
        lowerPriority();
        of_thread = niceness();
        std::thread([&] { of_its_own = niceness(); }).join();
    }).join();
    if (before < 19) {
        EXPECT_GT(of_thread, before);
    }
    EXPECT_EQ(of_its_own, of_thread);
    EXPECT_EQ(niceness(), before);
}

TEST(PerfCounter, IsNoneWhereTheKernelHasNone) {
    const system::PerfCounter none({PERF_TYPE_SOFTWARE, 0xffffff});
    EXPECT_EQ(none.read(), std::nullopt);
}

}  // namespace
}  // namespace engine
