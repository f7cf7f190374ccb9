#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/shader_reload.h"
#include "benchmarks/viewer/side.h"
#include "benchmarks/viewer/timings.h"
#include "engine/device.h"

namespace benchmarks::viewer {

// Whether the work is asked to end early.
using Stop = std::function<bool()>;

// A thread that works on one order at a time and replies to it. Orders and replies are values that
// move through a mailbox with room for one. Both threads share nothing else, and neither sees
// partial writes of the other. All functions are for the thread that created this.
template <class Order, class Reply>
class WorkerThread {
public:
    // Called on the thread. `stop` returns true once requestStop() was called.
    using Work = std::function<Reply(const Order& order, const Stop& stop)>;

    // `replied` is called on the thread when a reply is ready.
    WorkerThread(Work work, std::function<void()> replied)
        : work_(std::move(work)), replied_(std::move(replied)), thread_([this] { run(); }) {}

    // Asks the thread to stop and waits for the current order.
    ~WorkerThread() {
        requestStop();
        thread_.join();
    }
    WorkerThread(const WorkerThread&) = delete;
    WorkerThread& operator=(const WorkerThread&) = delete;

    // Whether an order was given and its reply is not taken yet.
    bool busy() const { return busy_; }

    // Hands over an order. Must not be busy.
    void begin(Order order) {
        const std::scoped_lock lock(mutex_);
        order_ = std::move(order);
        busy_ = true;
        changed_.notify_all();
    }

    // Returns the reply once it is ready, or throws the exception of the work. Then no longer busy.
    std::optional<Reply> take() {
        const std::scoped_lock lock(mutex_);
        if (!isDone()) return std::nullopt;
        busy_ = false;
        if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
        return std::exchange(reply_, std::nullopt);
    }

    // Waits until a reply is ready or nothing is pending. Returns false on a timeout.
    bool waitFor(std::chrono::microseconds patience) {
        std::unique_lock lock(mutex_);
        return !busy_ || changed_.wait_for(lock, patience, [this] { return isDone(); });
    }

    // Asks the work to end early, permanently.
    void requestStop() {
        const std::scoped_lock lock(mutex_);
        stops_ = true;
        changed_.notify_all();
    }

private:
    bool isDone() const { return reply_.has_value() || error_ != nullptr; }

    void run() {
        const Stop stop = [this] { return stops_.load(); };
        std::unique_lock lock(mutex_);
        while (true) {
            changed_.wait(lock, [this] { return order_.has_value() || stops_; });
            if (stops_) return;
            const Order order = *std::exchange(order_, std::nullopt);
            lock.unlock();
            std::optional<Reply> reply;
            std::exception_ptr error;
            try {
                reply = work_(order, stop);
            } catch (...) {
                error = std::current_exception();
            }
            lock.lock();
            reply_ = std::move(reply);
            error_ = error;
            changed_.notify_all();
            lock.unlock();
            replied_();
            lock.lock();
        }
    }

    Work work_;
    std::function<void()> replied_;
    bool busy_ = false;  // only for the thread that gives orders
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Order> order_;
    std::optional<Reply> reply_;
    std::exception_ptr error_;
    std::atomic<bool> stops_ = false;
    std::thread thread_;
};

// Plays and draws the scene on a separate thread and device. It takes orders and gives replies,
// both plain values.

// The runner's measurement of a side.
struct MeasureOrder {
    std::uint64_t side = 0;
    std::string name;  // of the scene
    // Called on the measuring thread.
    measure::MeasureHooks hooks;
};

// The window's requests in one order.
struct Order {
    std::vector<SideOrder> sides;  // all wanted sides; others are removed
    std::optional<std::uint32_t> seek;
    std::uint32_t frames = 0;  // number to play; the last one is drawn
    engine::Timing timing = engine::Timing::isolated;
    unsigned level = 0;  // of preview
    std::optional<std::uint64_t> count;  // the side with a picture to count work of
    std::optional<MeasureOrder> measure;
};

struct Reply {
    std::vector<SideReply> sides;
    unsigned level = 0;  // drawn level
    // Time of playing and drawing. For frames on the way to another one, as after a seek, it is
    // only the time of the last one. 0: nothing was drawn.
    double milliseconds = 0.0;
    ShaderStatus shaders;
    engine::MemoryLedger memory;  // the device's memory by owner
    // For the sides in the order's requests.
    std::optional<report::CaseResult> counted;
    std::optional<SideMeasurement> measured;
    std::string not_measured;  // why a requested measurement failed
};

// The players of all sides, and the watched shaders. Used by one thread at a time.
class Studio {
public:
    // `before` is called with each order before any work, for tests that delay it; may be empty.
    // The sides share `cache`.
    Studio(
        const engine::Device& device, const std::filesystem::path& shaders,
        std::function<void()> before = {}, measure::HairCache cache = measure::HairCache());

    // Carries out an order. If asked to stop, ends between two frames without a picture of the
    // skipped ones. Throws engine::DeviceLost; other errors are in the reply.
    Reply perform(const Order& order, const Stop& stop);

private:
    // A side, and the revision of its played settings.
    struct Played {
        Played(
            const engine::Device& device, const SideOrder& order,
            const std::filesystem::path& directory, measure::HairCache& cache, unsigned level)
            : player(device, order.settings, directory, &cache, level) {}

        Player player;
        std::uint64_t revision = 0;  // last applied or refused
        std::string problem;
        std::uint64_t pictures = 0;  // the player's pictures at the last reply
        bool lacks_guides = false;  // in the last reply
    };

    void reloadShaders();
    void admit(const Order& order, Reply& reply);
    void make(const SideOrder& order, unsigned level, SideReply& reply);
    static void reread(Played& played, SideReply& reply);
    static void follow(Played& played, const SideOrder& order, SideReply& reply);
    void play(const Order& order, const Stop& stop, Reply& reply);
    static void advance(Player& player, const Order& order, const Stop& stop, SideReply& reply);
    void measure(const MeasureOrder& order, Reply& reply);

    const engine::Device& device_;
    std::function<void()> before_;
    measure::HairCache cache_;
    ShaderReload reload_;
    std::map<std::uint64_t, std::unique_ptr<Played>> played_;  // by side id
    std::uint64_t replied_ = 0;  // number of replied pictures
};

}  // namespace benchmarks::viewer
