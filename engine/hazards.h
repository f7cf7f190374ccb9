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

#include "engine/instance.h"

// Whether what is recorded is ordered. The validation layer doesn't see memory that shaders reach
// by its address, and a device that runs its commands one after the other works without any
// barrier: so commands say what they touch (Commands::uses), and what they say is held here against
// the barriers between them, by the rules of the Vulkan specification's chapter 7.
namespace engine {

class MessageLog;

// Stages of the device and what memory accesses of theirs are meant.
struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
};

// A buffer or image, for as long as it lives; numbers are not used again.
using ResourceId = std::uint32_t;

// What one command touches.
struct RecordedUse {
    ResourceId resource = 0;
    Scope scope;
};

// A dependency between all before and all after it. One of an image makes only that visible, and
// one that changes an image's layout is a write of it.
struct RecordedBarrier {
    Scope before;
    Scope after;
    std::optional<ResourceId> image;
    bool changes_layout = false;
    std::string place;  // in the source: "hair_hair.cpp:187"
};

struct Recorded {
    std::string pass;  // empty: outside of passes
    std::vector<RecordedUse> uses;  // of one command, which don't depend on one another
    std::vector<RecordedBarrier> barriers;  // of one command, which don't chain; instead of uses
};

// A command buffer, in the order of recording.
using Recording = std::vector<Recorded>;

// A use that is not ordered after an earlier one.
struct Hazard {
    enum class Kind { read_after_write, write_after_read, write_after_write };

    Kind kind;
    ResourceId resource;
    std::string earlier;  // pass
    std::string later;  // pass
};

// Follows submissions to one queue, one after the other, and finds the hazards in them.
class HazardChecker {
public:
    // The hazards between the recording and all before it, and within it.
    std::vector<Hazard> submit(const Recording& recording);

    // The host has waited for all submissions so far up to this one, counted from 1: what comes
    // later depends on nothing that they did.
    void finish(std::uint64_t submission);

    // What is submitted from now on waits on the device, by a semaphore, for this submission,
    // counted from 1.
    void waitFor(std::uint64_t submission);

    void forget(ResourceId resource) { states_.erase(resource); }

private:
    // A use of a resource, and who comes after it for certain.
    struct Done {
        Scope scope;
        std::string pass;
        std::uint64_t submission = 0;
        VkPipelineStageFlags2 ordered = 0;  // stages whose later commands come after it
        bool available = false;  // a write: a barrier has made it available
        std::vector<Scope> visible;  // a write: to whom
    };
    struct State {
        std::optional<Done> write;  // the last one
        std::vector<Done> reads;  // since then
    };

    void forgetIf(const std::function<bool(const Done&)>& is_over);
    void changeLayout(
        const RecordedBarrier& barrier, const std::string& pass, std::vector<Hazard>& found);
    void apply(
        const std::vector<RecordedBarrier>& barriers, const std::string& pass,
        std::vector<Hazard>& found);
    void apply(
        const std::vector<RecordedUse>& uses, const std::string& pass, std::vector<Hazard>& found);

    std::map<ResourceId, State> states_;
    std::uint64_t submissions_ = 0;
};

// The places of barriers without which the recordings, submitted one after the other, have no
// hazard that they don't have anyway. Changes of layout are not among them: they are needed for the
// layout. Two that each make the other superfluous are both named.
std::vector<std::string> superfluousBarriers(std::span<const Recording> recordings);

// The places of all barriers but changes of layout.
std::set<std::string> barrierPlaces(std::span<const Recording> recordings);

// The buffers and images of a device, what its queue was given, and the hazards in it, as messages.
// Made where validation is on. For one thread.
class HazardLog {
public:
    explicit HazardLog(MessageLog& messages) : messages_(messages) {}
    HazardLog(const HazardLog&) = delete;
    HazardLog& operator=(const HazardLog&) = delete;

    // A buffer or image that is known for as long as its owner keeps this; move-only.
    class Entry {
    public:
        Entry() = default;
        Entry(HazardLog& log, ResourceId id) : log_(&log), id_(id) {}
        Entry(Entry&& other) noexcept { swap(other); }
        Entry& operator=(Entry&& other) noexcept {
            swap(other);
            return *this;
        }
        ~Entry() {
            if (log_) log_->remove(id_);
        }

        // The host writes to the buffer now. Nothing without a log.
        void hostWrites() const {
            if (log_) log_->hostWrites(id_);
        }

    private:
        void swap(Entry& other) noexcept {
            std::swap(log_, other.log_);
            std::swap(id_, other.id_);
        }

        HazardLog* log_ = nullptr;
        ResourceId id_ = 0;
    };

    // `mapped`: what the host sees of it; empty where it doesn't.
    Entry addBuffer(
        std::uint64_t address, std::size_t size, std::span<const std::byte> mapped,
        const std::string& name);
    Entry addImage(VkImage image, const std::string& name);

    // The buffer that the address lies in; none of ours where absent.
    std::optional<ResourceId> bufferAt(std::uint64_t address) const;
    ResourceId image(VkImage image) const { return images_.at(image); }

    // The buffers that the host writes and that addresses in `bytes` lead to, directly or through
    // one another.
    std::vector<ResourceId> hostBuffersIn(std::span<const std::byte> bytes) const;
    // The buffers that commands of passes have written and that addresses in `bytes` lie in.
    std::vector<ResourceId> writtenBuffersIn(std::span<const std::byte> bytes) const;

    // Takes what was recorded, which is submitted next; hazards become messages.
    void submit(Recording recording);
    // How many submissions there were.
    std::uint64_t submissions() const { return submissions_; }
    // The host has waited for this submission and all before it.
    void finish(std::uint64_t submission);
    // The device waits for this submission before what is submitted from now on.
    void waitFor(std::uint64_t submission) { checker_.waitFor(submission); }

    // A dispatch of a pass that doesn't say what it touches, or not all that it is handed.
    void complain(const std::string& pass, const std::string& what);
    std::string name(ResourceId id) const;

    // For tests. The barrier or change of layout that is recorded as number `index` from now on
    // orders nothing. Absent: all do.
    void drop(std::optional<std::uint32_t> index);
    // Where that was, once it was recorded.
    const std::optional<std::string>& dropped() const { return dropped_; }
    // Whether a barrier that is recorded now is the one to drop.
    bool isDropped(const std::string& pass, const std::string& place);
    // Barriers recorded since drop() was called.
    std::uint32_t barriers() const { return barriers_; }

    // For tests: the recordings submitted since the last call.
    std::vector<Recording> takeRecordings() { return std::exchange(recordings_, {}); }
    void keepRecordings() { keeps_recordings_ = true; }

private:
    struct Resource {
        std::string name;
        std::uint64_t address = 0;  // 0: an image
        std::size_t size = 0;
        std::span<const std::byte> mapped;
        VkImage image{};
        bool written = false;  // by a pass
        std::uint64_t last_submission = 0;  // that touches it
    };

    void remove(ResourceId id);
    void hostWrites(ResourceId id);
    void report(const std::string& message);

    MessageLog& messages_;
    std::map<ResourceId, Resource> resources_;
    std::map<std::uint64_t, ResourceId> buffers_;  // by their first address
    std::map<VkImage, ResourceId> images_;
    ResourceId next_ = 0;
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
