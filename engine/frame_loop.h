#pragma once

#include <chrono>
#include <cstdint>
#include <concepts>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/commands.h"
#include "engine/process.h"
#include "engine/queries.h"

namespace engine {

template <class Signature>
class FunctionRef;

// Something that can be called and that lives elsewhere, for at least as long: what frames are
// recorded by is handed on without a copy of it, which std::function would allocate.
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
    overlapped,  // as the Overlap says, several frames in flight: the frame as it is used
    isolated,    // stamp, full barrier, pass, full barrier, stamp; one frame at a time
    wall_clock,  // every pass submitted and waited for by itself, timed by the CPU
    statistics,  // untimed, with pipeline statistics of the graphics passes
};

// Where overlapped frames are stamped. A stamp after a pass is one more thing that the device does,
// and its driver may end there what would go on beside the next pass.
enum class Stamps {
    frame,  // at both ends of a frame: what its passes took is not known
    passes,  // after each pass too
};

// How overlapped frames are played.
struct Overlap {
    std::uint32_t frames = 2;  // in flight at most; from 1 to FrameLoop::kMaxSlots
    Stamps stamps = Stamps::frame;
    // What is recorded by Passes::beside() goes to the device's second queue (to the first, in a
    // submission of its own, where there is none). With Stamps::frame alone: the stamps are those
    // of the rest.
    bool async = false;
};

enum class PassKind {
    compute,
    graphics,  // draws from vertices alone
    meshes,  // draws from task and mesh stages alone
};

struct PassTime {
    std::string name;
    double milliseconds = 0.0;
    ProcessUse use;  // CPU: of the whole process while the pass ran (wall_clock)
};

struct PassStatistics {
    std::string name;
    StatisticCounts counts{};
};

// What was measured of one frame. Times are in ms.
struct FrameRecord {
    double interval = 0.0;  // CPU: from this frame's start to the next one's
    double wall = 0.0;  // CPU: from submission until completion was seen (isolated, wall_clock)
    double record = 0.0;  // CPU: recording the commands
    double submit = 0.0;  // CPU: in vkQueueSubmit2
    double wait = 0.0;  // CPU: for the device (overlapped: until a slot was free)
    // CPU time of this thread, for recording and submitting: without what else the machine did
    // meanwhile and what the driver's threads do. Absent in wall_clock.
    std::optional<double> host{};
    ProcessUse use;  // CPU: of the whole process, from recording to completion (not overlapped)
    // GPU: first to last stamp (overlapped, isolated). Absent, and `passes` empty but in
    // wall_clock, where the device's queue has no timestamps.
    std::optional<double> device;
    // Passes of one name are summed. Empty in overlapped frames that are stamped at both ends only.
    std::vector<PassTime> passes;
    std::vector<PassStatistics> statistics;
};

// Handed to the function that records a frame.
class Passes {
public:
    virtual ~Passes() = default;

    // Records one pass. Its name is the debug label, the timer and the metric.
    virtual void pass(const char* name, PassKind kind, FunctionRef<void(Commands&)> record) = 0;

    // Calls `record`, whose passes may run beside the drawing of the last `frames` frames, but only
    // after all that was submitted before those. What is recorded later comes after them. They are
    // compute passes, and the first of their frame.
    virtual void beside(std::uint32_t frames, FunctionRef<void()> record);

    // Whether passes may share a rendering scope, that one begins and another ends: not where each
    // is measured by itself, or something is added to one.
    virtual bool joins() const { return false; }

    // Index of the frame in flight, below FrameLoop::kMaxSlots: for buffers that the CPU writes
    // each frame.
    std::uint32_t slot() const { return slot_; }

protected:
    std::uint32_t slot_ = 0;
};

// Records, submits and times frames. Every frame is one command buffer, but in the wall_clock mode.
class FrameLoop {
public:
    static constexpr std::uint32_t kMaxSlots = 4;

    FrameLoop(const Device& device, Timing timing, const Overlap& overlap = {});
    ~FrameLoop();
    FrameLoop(const FrameLoop&) = delete;
    FrameLoop& operator=(const FrameLoop&) = delete;

    // Recording and submitting overlapped frames allocates no memory: what is measured of them has
    // its own, which finish() makes ready for as many frames as there were since the last call.
    void frame(FunctionRef<void(Passes&)> record);

    // What was measured of frames that are complete, oldest first, without waiting for any; each
    // frame is returned once, by this or by finish(). The newest frame is not among them: its
    // interval ends with the next one.
    std::vector<FrameRecord> completed();

    // Waits for all frames; returns what was measured of each since the last call. The interval of
    // the last frame runs until here, so it contains the wait: leave it out of statistics.
    std::vector<FrameRecord> finish();

private:
    struct OwnBuffer;
    struct Slot;
    void collect(Slot& slot);
    void endBeside(Commands& beside, std::uint64_t drawn);
    std::vector<FrameRecord> takeRecords();

    const Device& device_;
    Timing timing_;
    Stamps stamps_;
    Handle<VkSemaphore, &vkDestroySemaphore> timeline_;
    std::uint64_t submitted_ = 0;
    // Of submissions to the second queue; null where there are none.
    Handle<VkSemaphore, &vkDestroySemaphore> beside_;
    std::uint64_t submitted_beside_ = 0;
    // As HazardLog counts, by values of the timeline that nothing on the second queue waits for
    // yet.
    std::map<std::uint64_t, std::uint64_t> drawn_;
    std::vector<std::unique_ptr<Slot>> slots_;
    std::uint64_t frames_ = 0;
    std::vector<FrameRecord> records_;  // of frames that were not returned yet
    std::chrono::steady_clock::time_point start_{};  // of the newest frame
};

// ms on the device that a pass of isolated frames takes which records nothing: two barriers and two
// stamps, the median of some frames. What a pass takes is not known better than this. Absent where
// the device has no timestamps. Waits for the device.
std::optional<double> emptyPassTime(const Device& device);

}  // namespace engine
