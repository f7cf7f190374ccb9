#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <source_location>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/barriers.h"
#include "engine/instance.h"

// Checks that recorded commands are synchronised. The validation layer doesn't see memory that
// shaders reach by address, and on a device that runs commands one after the other, missing
// barriers have no effect. So what commands declare that they touch (Commands::uses) is checked
// against the barriers between them by the rules of chapter 7 of the Vulkan specification, whatever
// planned these barriers.
namespace engine {

class MessageLog;

using ResourceId = TrackedResources::Id;

// One use of a resource by a command.
struct RecordedUse {
    ResourceId resource = 0;
    Scope scope;
};

// A dependency between all earlier and all later commands. An image barrier makes only that image's
// accesses visible. A layout change counts as a write to the image.
struct RecordedBarrier {
    Scope before;
    Scope after;
    std::optional<ResourceId> image;
    bool transitions_layout = false;
    std::string place;  // in the source code: "hair_hair.cpp:187"
};

struct Recorded {
    std::string pass;  // empty: outside passes
    std::vector<RecordedUse> uses;  // of one command; they don't depend on one another
    std::vector<RecordedBarrier> barriers;  // of one command; they don't chain; instead of uses
};

// A command buffer in recording order.
using Recording = std::vector<Recorded>;

// The names of the buffers and images that a pass touches, and its barriers.
struct PassUses {
    std::string pass;
    std::set<std::string> reads;  // without those that it writes
    std::set<std::string> writes;
    std::uint32_t barriers = 0;
};

// A use that is not ordered after an earlier one.
struct Hazard {
    enum class Kind { read_after_write, write_after_read, write_after_write };

    Kind kind;
    ResourceId resource;
    std::string earlier;  // pass
    std::string later;  // pass
};

// Follows submissions, one after the other, and finds the hazards in them. A barrier orders only
// what was submitted to its own kind of queue.
class HazardChecker {
public:
    // Returns the hazards within the recording and against everything before it.
    std::vector<Hazard> submit(const Recording& recording, QueueKind queue = QueueKind::all);

    // The host has waited for all submissions up to this one, counted from 1. Later work depends on
    // nothing in them.
    void finish(std::uint64_t submission);

    // Later submissions wait on the device, by a semaphore, for this submission, counted from 1.
    void waitFor(std::uint64_t submission);

    void forget(ResourceId resource) { states_.erase(resource); }

private:
    // A use of a resource, and what is known to come after it.
    struct Done {
        Scope scope;
        std::string pass;
        std::uint64_t submission = 0;
        QueueKind queue = QueueKind::all;
        VkPipelineStageFlags2 ordered = 0;  // stages in which all later commands come after it
        bool available = false;  // a write: a barrier has made it available
        std::vector<Scope> visible;  // for a write: the scopes it is visible to
    };
    struct State {
        std::optional<Done> write;  // the last one
        std::vector<Done> reads;  // since that write
    };

    void forgetIf(const std::function<bool(const Done&)>& is_over);
    void transitionLayout(
        const RecordedBarrier& barrier, const std::string& pass, std::vector<Hazard>& found);
    void apply(
        const std::vector<RecordedBarrier>& barriers, const std::string& pass,
        std::vector<Hazard>& found);
    void apply(
        const std::vector<RecordedUse>& uses, const std::string& pass, std::vector<Hazard>& found);

    std::map<ResourceId, State> states_;
    std::uint64_t submissions_ = 0;
    QueueKind queue_ = QueueKind::all;  // of the recording that is looked at
};

// Returns the places of barriers that can each be left out: without it, the recordings, submitted
// one after the other, have no additional hazard. Layout changes are not listed, because the layout
// needs them. Two barriers that make each other redundant are both listed.
std::vector<std::string> redundantBarriers(std::span<const Recording> recordings);

// Returns the places of all barriers except those that change layouts too.
std::set<std::string> barrierPlaces(std::span<const Recording> recordings);

// The submissions to a device's queues, and the hazards in them, as messages. Exists if validation
// is on. For one thread.
class HazardLog {
public:
    HazardLog(MessageLog& messages, TrackedResources& resources);
    HazardLog(const HazardLog&) = delete;
    HazardLog& operator=(const HazardLog&) = delete;

    // Returns the host-written buffers that addresses in `bytes` point into, directly or through
    // one another.
    std::vector<ResourceId> hostBuffersIn(std::span<const std::byte> bytes) const;
    // Returns the buffers that passes have written and that addresses in `bytes` point to.
    std::vector<ResourceId> writtenBuffersIn(std::span<const std::byte> bytes) const;

    // Takes a recording that is submitted next. Hazards become messages.
    void submit(Recording recording, QueueKind queue = QueueKind::all);
    // Number of submissions so far.
    std::uint64_t submissions() const { return submissions_; }
    // The host has waited for this submission and all before it.
    void finish(std::uint64_t submission);
    // Later submissions wait on the device for this submission.
    void waitFor(std::uint64_t submission) { checker_.waitFor(submission); }

    // Reports a dispatch of a pass that doesn't declare its uses, or doesn't declare all buffers in
    // its push constants.
    void complain(const std::string& pass, const std::string& what);
    // The host writes to the buffer now.
    void hostWrites(ResourceId id);
    std::string name(ResourceId id) const { return resources_.at(id).memory.name; }

    // Returns the passes of a recording in the order in which they begin.
    std::vector<PassUses> passesOf(const Recording& recording) const;

    // For tests. The barrier or layout change with the number `index`, counted from now on, orders
    // nothing. If `index` is absent, none is dropped.
    void drop(std::optional<std::uint32_t> index);
    // Place of the dropped barrier, once it was recorded.
    const std::optional<std::string>& dropped() const { return dropped_; }
    // Returns whether the barrier recorded now is the one to drop.
    bool isDropped(const std::string& pass, const std::string& place);
    // Barriers recorded since drop() was called.
    std::uint32_t barriers() const { return barriers_; }

    // The recordings submitted since the last call, once keepRecordings() was called.
    std::vector<Recording> takeRecordings() { return std::exchange(recordings_, {}); }
    void keepRecordings() { keeps_recordings_ = true; }

private:
    struct Uses {
        bool written = false;  // by a pass
        std::uint64_t last_submission = 0;  // that touches the resource
    };

    void report(const std::string& message);

    MessageLog& messages_;
    TrackedResources& resources_;
    std::map<ResourceId, Uses> uses_;
    HazardChecker checker_;
    std::uint64_t submissions_ = 0;
    std::uint64_t finished_ = 0;
    std::set<std::string> reported_;
    std::optional<std::uint32_t> drop_;
    std::optional<std::string> dropped_;
    std::uint32_t barriers_ = 0;
    bool keeps_recordings_ = false;
    std::vector<Recording> recordings_;
};

}  // namespace engine
