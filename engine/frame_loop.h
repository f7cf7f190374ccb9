#pragma once

#include <array>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/commands.h"
#include "engine/instance.h"
#include "engine/process.h"
#include "engine/queries.h"

namespace engine {

// Host memory for a command pool's driver. Some drivers, such as lavapipe, allocate for each
// recorded command and free everything when the buffer is recorded again; malloc() isn't made for
// that. Power-of-two blocks are kept for the next frame; larger ones come from malloc(). Not
// thread-safe: drivers call these only within commands on the pool, on the command's thread, and
// one command at a time (Vulkan specification, Host Memory).
class RecordingMemory {
public:
    RecordingMemory() = default;
    RecordingMemory(const RecordingMemory&) = delete;
    RecordingMemory& operator=(const RecordingMemory&) = delete;

    // Valid during this object's lifetime. Allocation returns null without memory, as Vulkan
    // requires.
    const VkAllocationCallbacks* callbacks() const { return &callbacks_; }

private:
    static constexpr std::size_t kUnit = 64;  // bytes of the smallest blocks
    static constexpr std::size_t kKinds = 8;  // block sizes, 64 bytes to 8 KiB

    // Precedes the bytes handed out.
    struct alignas(std::max_align_t) Header {
        void* place;  // next free block, or malloc()'s pointer
        std::size_t size;  // bytes handed out
        std::size_t kind;  // size class of the block; kKinds: from malloc()
    };

    static VKAPI_ATTR void* VKAPI_CALL
    allocate(void* self, std::size_t size, std::size_t alignment, VkSystemAllocationScope scope);
    static VKAPI_ATTR void* VKAPI_CALL reallocate(
        void* self, void* given, std::size_t size, std::size_t alignment,
        VkSystemAllocationScope scope);
    static VKAPI_ATTR void VKAPI_CALL release(void* self, void* given);
    static Header& headerOf(void* given) { return *(static_cast<Header*>(given) - 1); }
    static void* allocateAlone(std::size_t size, std::size_t alignment);
    bool addBlocks(std::size_t kind);

    std::array<Header*, kKinds> free_{};
    std::vector<std::unique_ptr<std::byte[]>> slabs_;
    VkAllocationCallbacks callbacks_{this, &allocate, &reallocate, &release, nullptr, nullptr};
};

template <class Signature>
class FunctionRef;

// A non-owning reference to a callable, which must outlive it. It avoids the allocation that a copy
// into std::function would make.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
public:
    template <class Function>
        requires(!std::same_as<std::remove_cvref_t<Function>, FunctionRef> &&
                 std::is_invocable_r_v<Result, Function&, Arguments...>)
    FunctionRef(Function&& function)
        : function_(const_cast<void*>(static_cast<const void*>(std::addressof(function)))),
          call_([](void* called, Arguments... arguments) -> Result {
              return (*static_cast<std::remove_reference_t<Function>*>(called))(
                  std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(function_, std::forward<Arguments>(arguments)...);
    }

private:
    void* function_;
    Result (*call_)(void*, Arguments...);
};

// How the passes of a frame are timed. Figures of different modes are never compared.
enum class Timing {
    overlapped,  // as set by Overlap, with several frames in flight: the frame as it is normally
                 // used
    isolated,  // timestamp, full barrier, pass, full barrier, timestamp; one frame at a time
    wall_clock,  // every pass submitted and waited for by itself, timed by the CPU
    statistics,  // untimed, with pipeline statistics of the graphics passes
};

// Places of timestamps in overlapped frames. A timestamp after a pass is extra work for the device,
// and the driver may wait there for work that would otherwise overlap the next pass.
enum class TimestampPlacement {
    frame,  // at both ends of a frame: pass times are unknown
    passes,  // after each pass too
};

// How overlapped frames are played.
struct Overlap {
    std::uint32_t frames = 2;  // in flight at most; from 1 to FrameLoop::kMaxSlots
    TimestampPlacement timestamps = TimestampPlacement::frame;
    // Sends passes recorded by Passes::asyncCompute() to the device's second queue, or to the first
    // in a submission of their own if there is no second. Only with TimestampPlacement::frame; the
    // timestamps then cover only the remaining passes.
    bool async = false;
};

enum class PassKind {
    compute,
    graphics,  // vertex draws only
    meshes,  // draws of task and mesh stages only
};

struct PassTime {
    std::string name;
    double milliseconds = 0.0;
    ProcessUse use;  // CPU use of the whole process while the pass ran (wall_clock)
    std::uint32_t parts = 1;  // passes of this name, summed; each is timed by itself
};

struct PassStatistics {
    std::string name;
    StatisticCounts counts{};
};

// Measurements of one frame. Times are in ms.
struct FrameRecord {
    double interval = 0.0;  // CPU: from the start of this frame to that of the next
    double wall = 0.0;  // CPU: from submission until completion was seen (isolated, wall_clock)
    double record = 0.0;  // CPU: to record the commands
    double submit = 0.0;  // CPU: in vkQueueSubmit2
    double wait = 0.0;  // CPU: waiting for the device (overlapped: for a free slot)
    // CPU time of this thread for recording and submitting. Excludes other processes and the
    // driver's threads. Absent in wall_clock.
    std::optional<double> host{};
    ProcessUse use;  // CPU use of the whole process, from recording to completion (not overlapped)
    // GPU: from the first to the last timestamp (overlapped, isolated). Absent if the device's
    // queue has no timestamps; then `passes` is empty too, except in wall_clock.
    std::optional<double> device;
    // GPU: from the last timestamp of the previous frame to the first of this one: the queue had no
    // work. Negative if this frame began earlier. Absent as `device`, and for a loop's first frame.
    std::optional<double> gap{};
    // Passes of the same name are summed. Empty in overlapped frames with
    // TimestampPlacement::frame.
    std::vector<PassTime> passes;
    std::vector<PassStatistics> statistics;
};

// Passed to the function that records a frame.
class Passes {
public:
    virtual ~Passes() = default;

    // Records one pass. Its name serves as debug label, timer and metric.
    virtual void pass(const char* name, PassKind kind, FunctionRef<void(Commands&)> record) = 0;

    // Calls `record`. Its passes may run while the last `frames` frames are drawn, but wait for
    // everything submitted before those frames. Passes recorded later wait for them. They must be
    // compute passes and the first of their frame.
    virtual void asyncCompute(std::uint32_t frames, FunctionRef<void()> record);

    // Whether a pass may be recorded in parts, and passes may share a rendering scope that one
    // begins and another ends. False if each pass is measured by itself or something is added to a
    // pass.
    virtual bool joins() const { return false; }

    // Index of the frame in flight, below FrameLoop::kMaxSlots. For buffers that the CPU writes
    // each frame.
    std::uint32_t slot() const { return slot_; }

protected:
    std::uint32_t slot_ = 0;
};

// Records, submits and times frames. Every frame is one command buffer, except in wall_clock mode.
class FrameLoop {
public:
    static constexpr std::uint32_t kMaxSlots = 4;

    FrameLoop(const Device& device, Timing timing, const Overlap& overlap = {});
    ~FrameLoop();
    FrameLoop(const FrameLoop&) = delete;
    FrameLoop& operator=(const FrameLoop&) = delete;

    // Recording and submitting overlapped frames allocates no memory for records: finish() reserves
    // as many as there were frames since the last call.
    void frame(FunctionRef<void(Passes&)> record);

    // Returns the records of completed frames, oldest first, without waiting. This function or
    // finish() returns each frame once. The newest frame is left out: its interval ends with the
    // next frame.
    std::vector<FrameRecord> completed();

    // Waits for all frames and returns the records since the last call. The interval of the last
    // frame ends here, so it contains the wait: leave it out of statistics.
    std::vector<FrameRecord> finish();

private:
    struct OwnBuffer;
    struct Slot;
    class OneBufferPasses;
    class SubmittedPasses;
    void collect(Slot& slot);
    void setGaps(std::span<FrameRecord> records);
    void endAsync(Commands& async, std::uint64_t drawn);
    std::vector<FrameRecord> takeRecords();

    const Device& device_;
    Timing timing_;
    TimestampPlacement placement_;
    Handle<VkSemaphore, &vkDestroySemaphore> timeline_;
    std::uint64_t submitted_ = 0;
    // Timeline of submissions to the second queue; null if there are none.
    Handle<VkSemaphore, &vkDestroySemaphore> async_timeline_;
    std::uint64_t submitted_async_ = 0;
    // HazardLog submission numbers by timeline value, for frames that nothing on the second queue
    // waits for yet.
    std::map<std::uint64_t, std::uint64_t> drawn_;
    std::vector<std::unique_ptr<Slot>> slots_;
    std::uint64_t frames_ = 0;
    std::vector<FrameRecord> records_;  // of frames not returned yet
    std::vector<std::optional<Timestamps::Ends>> ends_;  // [record]
    std::optional<Timestamps::Ends> last_ends_;  // of the last frame returned
    std::chrono::steady_clock::time_point start_{};  // of the newest frame
};

// Returns the device time (ms) of an empty pass in isolated frames, that is two barriers and two
// timestamps: the median of some frames. Pass times are not known better than this. Absent if the
// device has no timestamps. Waits for the device.
std::optional<double> emptyPassTime(const Device& device);

}  // namespace engine
