#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

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

}  // namespace benchmarks::viewer
