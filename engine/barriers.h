#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/instance.h"

// Plans the barriers of recorded commands from what the commands declare that they touch. So no
// pass places a barrier itself: it says which buffers and images its next command reads and writes,
// and an ordering that is missing is made in front of that command.
//
// A barrier orders all work before it against all work after it, not only one resource. So the
// dependencies that wait for a barrier are intervals between a producer and its consumer, and the
// fewest barriers that cut all intervals are found by waiting with each as long as possible: until
// the first consumer that needs one. Each barrier then covers everything that may be waited for
// cheaply, also dependencies that are not known yet (BarrierPlan::take).
namespace engine {

// Pipeline stages and their memory accesses.
struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
};

// Stages and memory accesses of a command.
enum class Access {
    compute_read,
    compute_write,  // also reads
    graphics_read,  // buffers and images read by any graphics stage
    indirect_read,  // arguments of an indirect draw
    vertex_read,  // buffers read by the stages before the rasteriser: vertex to geometry, or task
                  // and mesh
    fragment_read,  // buffers and images read by the fragment stage
    shading_read,  // images read during shading, by the fragment stage or by compute
    fragment_write,  // buffers read and written by the fragment stage
    attachment,  // colour and depth attachments, read and written
    transfer_read,
    transfer_write,
    host_read,
    build_read,  // buffers and structures that the building of acceleration structures reads
    build_write,  // structures and scratch memory, read and written by it
    trace_read,  // structures in which compute traces rays
    fragment_trace,  // structures in which the fragment stage traces rays
};

Scope scopeOf(Access access);

// Everything that a device and its host do.
constexpr Scope kEverything{
    VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
    VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};

// Commands that a queue accepts.
enum class QueueKind {
    all,
    compute,  // no graphics: barriers omit graphics stages, which semaphores order
};

// The use of memory in one word, by which reports add it up: "simulation". There is no default, so
// nothing can be allocated without one.
class Purpose {
public:
    consteval Purpose(const char* name) : name_(name) {}

    std::string_view name() const { return name_; }

    auto operator<=>(const Purpose&) const = default;

private:
    std::string_view name_;
};

struct MemoryEntry {
    std::uint32_t heap = 0;  // of VkPhysicalDeviceMemoryProperties
    bool device_local = false;
    std::string name;  // of the buffer or image
    Purpose purpose;

    auto operator<=>(const MemoryEntry&) const = default;
};

// Bytes of device memory in live allocations.
using MemoryLedger = std::map<MemoryEntry, std::uint64_t>;

// All buffers and images of a device by number: for its memory, BarrierPlan and the hazard checker.
// Numbers are reused, except if a hazard checker watches.
class TrackedResources {
public:
    using Id = std::uint32_t;

    struct Resource {
        MemoryEntry memory;
        std::uint64_t allocated = 0;  // B
        std::uint64_t bytes = 0;  // B, without the driver's padding
        std::uint64_t address = 0;  // 0: an image
        std::span<const std::byte> mapped{};  // the host's view of a buffer, if it is mapped
        bool exists = true;
    };

    TrackedResources() = default;
    TrackedResources(const TrackedResources&) = delete;
    TrackedResources& operator=(const TrackedResources&) = delete;

    // A buffer or image for its lifetime; move-only.
    class Entry {
    public:
        Entry() = default;
        Entry(TrackedResources& all, Id id) : all_(&all), id_(id) {}
        Entry(Entry&& other) noexcept { swap(other); }
        Entry& operator=(Entry&& other) noexcept {
            swap(other);
            return *this;
        }
        ~Entry() {
            if (all_) all_->remove(id_);
        }

        Id id() const { return id_; }

    private:
        void swap(Entry& other) noexcept {
            std::swap(all_, other.all_);
            std::swap(id_, other.id_);
        }

        TrackedResources* all_ = nullptr;
        Id id_ = 0;
    };

    Entry add(Resource resource);

    // Returns the buffer that contains the address; absent if it is not one of ours.
    std::optional<Id> bufferAt(std::uint64_t address) const;
    // Returns a resource. If a checker watches, also one that no longer exists.
    const Resource& at(Id id) const { return resources_.at(id); }
    MemoryLedger memory() const;
    // Returns the bytes of all that exist without padding, added up by name.
    std::map<std::string, std::uint64_t> bytes() const;

    // Calls `removed` when a resource ends.
    void watch(std::function<void(Id)> removed) { removed_ = std::move(removed); }

private:
    friend class BarrierPlan;
    static constexpr std::size_t kClasses = 10;
    static constexpr std::size_t kQueues = 2;

    // Uses of a resource by the commands of one kind of queue. Times are BarrierPlan's.
    struct Uses {
        std::uint32_t writer = 0;  // class of the last write; after a change of layout, the classes
                                   // that the layout is for
        bool is_layout = false;  // the last write was a change of layout
        std::uint32_t visible = 0;  // classes for which the change of layout was made
        std::uint64_t written = 0;  // time of the last write; 0: none
        std::array<std::uint64_t, kClasses> read{};  // times of the reads since, by class
    };

    void remove(Id id);

    std::map<std::uint64_t, Id> buffers_;  // by their start address
    std::vector<std::array<Uses, kQueues>> uses_;
    std::vector<Resource> resources_;
    std::vector<Id> free_;  // numbers without a resource
    std::function<void(Id)> removed_;
};

// Makes what is before visible to what is after; nothing without stages before.
struct Dependency {
    Scope before;
    Scope after;
};

// One barrier. Its dependencies don't chain.
struct PlannedBarrier {
    Dependency shaders;  // on compute, transfers and the stages before the rasteriser
    Dependency drawing;  // on fragments and attachments
    Dependency layouts;  // of the images whose layouts change
};

// The barriers of the submissions to one queue, in the order in which they are recorded. Semaphores
// order the work of other queues.
//
// For each command: require() and change() for everything that it touches, take() the barrier in
// front of it, and commit() once the command is recorded.
class BarrierPlan {
public:
    BarrierPlan(TrackedResources& resources, QueueKind queue)
        : resources_(resources), queue_(static_cast<std::size_t>(queue)) {}

    void require(TrackedResources::Id id, Access access);
    // The next command touches everything that the last one touched.
    void requireAgain();
    // Forgets what was required, because the command has nothing to do. Layouts still change.
    void withdraw();
    // A rendering can hold no barrier, so in front of one everything that compute, transfers and
    // fragments wrote becomes visible to its stages.
    void requireForRendering();
    // The image is to be moved to another layout.
    void change(TrackedResources::Id image, VkImageLayout to);

    // Whether the next command needs a barrier.
    bool isNeeded() const {
        return shaders_.before != 0 || drawing_.before != 0 || !changes_.empty();
    }
    // Returns the barrier in front of the next command; absent if it needs none. A barrier waits
    // for more than the command needs if that is cheap: all later shaders and transfers wait for
    // compute and transfers, and in front of draws also for the stages of earlier draws before the
    // rasteriser, which have ended by then. So the next step of the simulation finds the copy of
    // the guides that it overwrites free, without waiting for the drawing of the other copy. For
    // fragments and attachments only those stages wait that must.
    std::optional<PlannedBarrier> take();
    // Later commands may have to wait for what was required.
    void commit();

    // A barrier that orders everything has been recorded.
    void orderedAll();
    // Nothing may be taken to be ordered: what was recorded is not submitted, or in another order.
    void forgetOrder();

    // Number of commands that are being recorded for the queue.
    std::uint32_t open = 0;

private:
    static constexpr std::size_t kClasses = TrackedResources::kClasses;
    using Classes = std::uint32_t;  // a bit for each class of stages
    using Times = std::array<std::array<std::uint64_t, kClasses>, kClasses>;  // [before][after]

    struct Required {
        TrackedResources::Id id;
        Access access;
    };

    struct Pair {
        Classes before = 0;
        Classes after = 0;
    };
    enum class Memory { of_images, all };

    TrackedResources::Uses& usesOf(TrackedResources::Id id);
    void wait(std::size_t earlier, std::size_t later);
    void order(const Times& ordered, Pair pair, Memory memory);
    void forgetNeeds();

    TrackedResources& resources_;
    std::size_t queue_;
    std::uint64_t now_ = 1;
    // Up to which time the work of one class is done before later work of another starts, and up to
    // which time what it wrote is visible to it.
    Times ordered_{};
    Times visible_{};
    std::array<std::uint64_t, kClasses> flushed_{};  // up to which time writes are available
    std::array<std::uint64_t, kClasses> used_{};  // time of the last use by a class
    std::array<std::uint64_t, kClasses> written_{};  // time of the last write by a class
    // Work that the next command waits for.
    Pair shaders_;
    Pair drawing_;
    Pair layouts_;
    std::vector<Required> required_;  // by the next command
    std::vector<Required> last_;  // by the last one
    std::vector<std::pair<TrackedResources::Id, VkImageLayout>> changes_;
};

}  // namespace engine
