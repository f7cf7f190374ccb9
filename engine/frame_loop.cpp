#include "engine/frame_loop.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>
#include <span>

#include "engine/recording_memory.h"

namespace engine {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kMaxStamps = 1024;

constexpr std::size_t kRecordsAtFirst = 64;  // frames

double millisecondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

void addTime(std::vector<PassTime>& passes, const PassTime& time) {
    const auto found = std::ranges::find(passes, time.name, &PassTime::name);
    if (found != passes.end()) {
        found->milliseconds += time.milliseconds;
        found->use = found->use + time.use;
    } else {
        passes.push_back(time);
    }
}

Handle<VkSemaphore, &vkDestroySemaphore> makeTimeline(VkDevice device) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    create.pNext = &type;
    VkSemaphore semaphore{};
    check(vkCreateSemaphore(device, &create, nullptr, &semaphore), "create a timeline semaphore");
    return {device, semaphore};
}

// An interrupt ends the program.
void waitFor(const Device& device, VkSemaphore timeline, std::uint64_t value) {
    VkSemaphoreWaitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    wait.semaphoreCount = 1;
    wait.pSemaphores = &timeline;
    wait.pValues = &value;
    device.await("wait for a frame", [&](std::uint64_t nanoseconds) {
        return vkWaitSemaphores(device.get(), &wait, nanoseconds);
    });
}

// A value of a timeline semaphore.
struct TimelinePoint {
    VkSemaphore timeline{};
    std::uint64_t value = 0;  // 0: from the start
};

VkSemaphoreSubmitInfo submitInfo(const TimelinePoint& point) {
    VkSemaphoreSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    info.semaphore = point.timeline;
    info.value = point.value;
    info.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    return info;
}

// `after`: the point to wait for; none if its value is 0.
void submit(
    VkQueue queue, VkCommandBuffer commands, const TimelinePoint& reached,
    const TimelinePoint& after = {}) {
    const VkCommandBufferSubmitInfo buffer{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .pNext = nullptr,
        .commandBuffer = commands,
        .deviceMask = 0};
    const VkSemaphoreSubmitInfo signal = submitInfo(reached);
    const VkSemaphoreSubmitInfo wait = submitInfo(after);
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.waitSemaphoreInfoCount = after.value > 0 ? 1 : 0;
    info.pWaitSemaphoreInfos = &wait;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &buffer;
    info.signalSemaphoreInfoCount = 1;
    info.pSignalSemaphoreInfos = &signal;
    check(vkQueueSubmit2(queue, 1, &info, VK_NULL_HANDLE), "submit a frame");
}

// Overlapped, isolated and statistics frames: all passes share one command buffer, except those for
// the second queue.
template <class Slot>
class OneBufferPasses : public Passes {
public:
    // `beside`: records for the second queue; null: everything goes to the first.
    OneBufferPasses(
        const Device& device, Timing timing, Stamps stamps, Slot& slot, std::uint32_t index,
        Commands& commands, Commands* beside)
        : device_(device), timing_(timing), stamps_(stamps), slot_data_(slot), commands_(&commands),
          beside_(beside) {
        slot_ = index;
        if (timing_ == Timing::overlapped && slot_data_.timestamps)
            slot_data_.timestamps->write(*commands_);
    }

    void pass(const char* name, PassKind kind, FunctionRef<void(Commands&)> record) override {
        commands_->beginLabel(name);
        switch (timing_) {
        case Timing::overlapped: {
            record(*commands_);
            if (!slot_data_.timestamps || stamps_ == Stamps::frame) break;
            const std::uint32_t stamp = slot_data_.timestamps->write(*commands_);
            slot_data_.spans.push_back({name, stamp - 1, stamp});
            break;
        }
        case Timing::isolated: {
            auto& stamps = slot_data_.timestamps;
            const std::uint32_t first = stamps ? stamps->write(*commands_) : 0;
            commands_->barrier(Access::anything, Access::anything);
            record(*commands_);
            commands_->barrier(Access::anything, Access::anything);
            if (stamps) slot_data_.spans.push_back({name, first, stamps->write(*commands_)});
            break;
        }
        case Timing::statistics:
            if (kind != PassKind::compute && device_.hasPipelineStatistics()) {
                const DrawnFrom drawn_from =
                    kind == PassKind::meshes ? DrawnFrom::meshes : DrawnFrom::vertices;
                auto& query =
                    slot_data_.queries.emplace_back(name, PipelineStatistics(device_, drawn_from));
                query.statistics.begin(*commands_);
                record(*commands_);
                query.statistics.end(*commands_);
                break;
            }
            [[fallthrough]];
        case Timing::wall_clock:
            record(*commands_);
            break;
        }
        commands_->endLabel();
        if (commands_ != beside_) drawing_ = true;
    }

    bool joins() const override {
        return timing_ == Timing::overlapped && stamps_ == Stamps::frame;
    }

    void beside(std::uint32_t frames, FunctionRef<void()> record) override {
        if (!beside_) return record();
        assert(!drawing_);
        least_ = std::min(least_.value_or(frames), frames);
        Commands* const others = std::exchange(commands_, beside_);
        record();
        commands_ = others;
    }

    // Frames that all passes recorded by beside() may overlap; absent: there are none.
    std::optional<std::uint32_t> leastBeside() const { return least_; }

    void end() {
        if (timing_ == Timing::overlapped && stamps_ == Stamps::frame && slot_data_.timestamps)
            slot_data_.timestamps->write(*commands_);
    }

private:
    const Device& device_;
    Timing timing_;
    Stamps stamps_;
    Slot& slot_data_;
    Commands* commands_;
    Commands* beside_;
    bool drawing_ = false;
    std::optional<std::uint32_t> least_;
};

// Wall-clock frames: one submission per pass.
template <class Slot>
class SubmittedPasses : public Passes {
public:
    SubmittedPasses(
        const Device& device, Slot& slot, VkSemaphore timeline, std::uint64_t& submitted,
        FrameRecord& record)
        : device_(device), slot_data_(slot), timeline_(timeline), submitted_(submitted),
          record_(record) {}

    void pass(const char* name, PassKind, FunctionRef<void(Commands&)> record) override {
        Commands commands(slot_data_.buffer, slot_data_.sets, device_.hazards());
        commands.begin();
        commands.beginLabel(name);
        commands.barrier(Access::anything, Access::anything);
        record(commands);
        commands.barrier(Access::anything, Access::anything);
        commands.endLabel();
        commands.end();
        const ProcessUse used = processUse();
        const Clock::time_point start = Clock::now();
        submit(device_.queue(), slot_data_.buffer, {timeline_, submitted_ + 1});
        ++submitted_;
        waitFor(device_, timeline_, submitted_);
        if (device_.hazards()) device_.hazards()->finish(device_.hazards()->submissions());
        const double time = millisecondsBetween(start, Clock::now());
        record_.wall += time;
        addTime(record_.passes, {name, time, processUse() - used});
    }

private:
    const Device& device_;
    Slot& slot_data_;
    VkSemaphore timeline_;
    std::uint64_t& submitted_;
    FrameRecord& record_;
};

}  // namespace

void Passes::beside(std::uint32_t, FunctionRef<void()> record) { record(); }

// A command pool of a queue family, with its own host memory.
class RecordingPool {
public:
    RecordingPool(const Device& device, std::uint32_t family) : device_(device) {
        const VkCommandPoolCreateInfo create{
            .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
            .pNext = nullptr,
            .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
            .queueFamilyIndex = family};
        check(
            vkCreateCommandPool(device.get(), &create, memory_->callbacks(), &pool_),
            "create a command pool");
    }
    RecordingPool(const RecordingPool&) = delete;
    RecordingPool& operator=(const RecordingPool&) = delete;
    ~RecordingPool() {
        if (isGivenUp(device_.get()))
            static_cast<void>(memory_.release());  // the driver still has pointers to it
        else
            vkDestroyCommandPool(device_.get(), pool_, memory_->callbacks());
    }

    VkCommandPool get() const { return pool_; }

private:
    const Device& device_;
    std::unique_ptr<RecordingMemory> memory_ = std::make_unique<RecordingMemory>();
    VkCommandPool pool_{};
};

// A command buffer of a queue family, with its pool and descriptor sets.
struct FrameLoop::OwnBuffer {
    OwnBuffer(const Device& device, std::uint32_t family) : pool(device, family), sets(device) {
        const VkCommandBufferAllocateInfo allocate{
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .pNext = nullptr,
            .commandPool = pool.get(),
            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
            .commandBufferCount = 1};
        check(
            vkAllocateCommandBuffers(device.get(), &allocate, &buffer),
            "allocate a command buffer");
    }

    RecordingPool pool;
    VkCommandBuffer buffer{};
    DescriptorSets sets;
};

// Resources of one frame in flight.
struct FrameLoop::Slot : OwnBuffer {
    Slot(const Device& device, Timing timing, bool async)
        : OwnBuffer(device, device.info().queue_family) {
        if (async) beside.emplace(device, device.info().compute_family);
        const bool stamped = timing == Timing::overlapped || timing == Timing::isolated;
        if (stamped && device.info().timestamp_valid_bits > 0) {
            timestamps.emplace(device, kMaxStamps);
        }
    }

    struct Span {
        std::string name;
        std::uint32_t first_stamp;
        std::uint32_t last_stamp;
    };
    struct Query {
        std::string name;
        PipelineStatistics statistics;
    };

    std::optional<OwnBuffer> beside;  // for the second queue
    std::optional<Timestamps> timestamps;
    std::vector<Span> spans;
    std::vector<Query> queries;
    std::uint64_t value = 0;  // timeline value that marks the slot's frame as done
    std::uint64_t submission = 0;  // HazardLog submission number
    std::optional<std::size_t> record;  // index of the record still to be read
};

FrameLoop::FrameLoop(const Device& device, Timing timing, const Overlap& overlap)
    : device_(device), timing_(timing), stamps_(overlap.stamps),
      timeline_(makeTimeline(device.get())) {
    assert(overlap.frames > 0 && overlap.frames <= kMaxSlots);
    const std::uint32_t count = timing == Timing::overlapped ? overlap.frames : 1;
    const bool async = timing == Timing::overlapped && overlap.async;
    assert(!async || overlap.stamps == Stamps::frame);
    for (std::uint32_t i = 0; i < count; ++i) {
        slots_.push_back(std::make_unique<Slot>(device, timing, async));
    }
    if (async) beside_ = makeTimeline(device.get());
    records_.reserve(kRecordsAtFirst);
}

FrameLoop::~FrameLoop() {
    try {
        waitFor(device_, timeline_.get(), submitted_);
        if (submitted_beside_ > 0) waitFor(device_, beside_.get(), submitted_beside_);
        vkQueueWaitIdle(device_.queue());
        vkQueueWaitIdle(device_.computeQueue());
    } catch (const Error&) {  // there is nothing to wait for on a lost device
    }
    if (device_.hazards()) device_.hazards()->finish(device_.hazards()->submissions());
}

void FrameLoop::frame(FunctionRef<void(Passes&)> record) {
    const auto index = static_cast<std::uint32_t>(frames_++ % slots_.size());
    Slot& slot = *slots_[index];
    const Clock::time_point start = Clock::now();
    // Overlapping frames have no CPU use of their own, and reading it takes time.
    const ProcessUse used = timing_ == Timing::overlapped ? ProcessUse{} : processUse();
    collect(slot);
    const double host = threadTime();
    const Clock::time_point free = Clock::now();
    if (!records_.empty()) records_.back().interval = millisecondsBetween(start_, start);
    start_ = start;
    FrameRecord& result = records_.emplace_back();

    if (timing_ == Timing::wall_clock) {
        SubmittedPasses<Slot> passes(device_, slot, timeline_.get(), submitted_, result);
        record(passes);
        result.use = processUse() - used;
        return;
    }

    if (slot.timestamps) slot.timestamps->reset();
    slot.spans.clear();
    slot.queries.clear();
    Commands commands(slot.buffer, slot.sets, device_.hazards());
    std::optional<Commands> beside;
    if (slot.beside)
        beside.emplace(
            slot.beside->buffer, slot.beside->sets, device_.hazards(), QueueKind::compute);
    commands.begin();
    if (beside) beside->begin();
    OneBufferPasses<Slot> passes(
        device_, timing_, stamps_, slot, index, commands, beside ? &*beside : nullptr);
    record(passes);
    passes.end();
    const std::uint64_t drawn =
        submitted_ - std::min<std::uint64_t>(submitted_, passes.leastBeside().value_or(0));
    if (beside) endBeside(*beside, drawn);
    commands.end();
    if (device_.hazards()) slot.submission = device_.hazards()->submissions();
    const Clock::time_point recorded = Clock::now();
    slot.value = submitted_ + 1;
    slot.record = records_.size() - 1;
    if (beside && device_.hazards()) drawn_[slot.value] = slot.submission;
    // Counted only after submission succeeded: nobody waits for what is not submitted.
    if (passes.leastBeside()) {
        submit(
            device_.computeQueue(), slot.beside->buffer, {beside_.get(), submitted_beside_ + 1},
            {timeline_.get(), drawn});
        ++submitted_beside_;
    }
    submit(
        device_.queue(), slot.buffer, {timeline_.get(), slot.value},
        {beside_.get(), submitted_beside_});
    submitted_ = slot.value;
    const Clock::time_point submitted = Clock::now();
    result.wait = millisecondsBetween(start, free);
    result.record = millisecondsBetween(free, recorded);
    result.submit = millisecondsBetween(recorded, submitted);
    result.host = threadTime() - host;
    if (timing_ != Timing::overlapped) {
        waitFor(device_, timeline_.get(), slot.value);
        const Clock::time_point done = Clock::now();
        result.wall = millisecondsBetween(recorded, done);
        result.wait = millisecondsBetween(submitted, done);
        result.use = processUse() - used;
        collect(slot);
    }
}

// Ends the second queue's commands, which wait until the timeline reaches `drawn`. The first
// queue's next submission waits for them.
void FrameLoop::endBeside(Commands& beside, std::uint64_t drawn) {
    HazardLog* const hazards = device_.hazards();
    if (hazards) {
        const auto end = drawn_.upper_bound(drawn);
        for (auto each = drawn_.begin(); each != end; ++each) hazards->waitFor(each->second);
        drawn_.erase(drawn_.begin(), end);
    }
    beside.end();
    if (hazards) hazards->waitFor(hazards->submissions());
}

std::vector<FrameRecord> FrameLoop::finish() {
    for (const auto& slot : slots_) collect(*slot);
    if (!records_.empty()) records_.back().interval = millisecondsBetween(start_, Clock::now());
    return takeRecords();
}

// Takes all records, and reserves as many for the next batch.
std::vector<FrameRecord> FrameLoop::takeRecords() {
    std::vector<FrameRecord> next;
    next.reserve(std::max(records_.size(), kRecordsAtFirst));
    return std::exchange(records_, std::move(next));
}

std::vector<FrameRecord> FrameLoop::completed() {
    std::size_t count = records_.empty() ? 0 : records_.size() - 1;
    for (const auto& slot : slots_)
        if (slot->record) count = std::min(count, *slot->record);
    const auto end = records_.begin() + static_cast<std::ptrdiff_t>(count);
    std::vector<FrameRecord> complete(
        std::make_move_iterator(records_.begin()), std::make_move_iterator(end));
    records_.erase(records_.begin(), end);
    for (const auto& slot : slots_)
        if (slot->record) *slot->record -= count;
    return complete;
}

// Waits for the slot's frame and reads its measurements.
void FrameLoop::collect(Slot& slot) {
    if (!slot.record) return;
    waitFor(device_, timeline_.get(), slot.value);
    if (device_.hazards()) device_.hazards()->finish(slot.submission);
    FrameRecord& record = records_[*slot.record];
    slot.record.reset();
    if (slot.timestamps) {
        const std::span<const double> times = slot.timestamps->read();
        for (const Slot::Span& span : slot.spans) {
            addTime(
                record.passes,
                {span.name, times[span.last_stamp] - times[span.first_stamp], ProcessUse{}});
        }
        if (!times.empty()) record.device = times.back();
    }
    for (Slot::Query& query : slot.queries) {
        record.statistics.push_back({query.name, query.statistics.read()});
    }
}

std::optional<double> emptyPassTime(const Device& device) {
    constexpr std::size_t kFrames = 33;
    if (device.info().timestamp_valid_bits == 0) return std::nullopt;
    FrameLoop loop(device, Timing::isolated);
    for (std::size_t i = 0; i < kFrames; ++i)
        loop.frame(
            [](Passes& passes) { passes.pass("empty", PassKind::compute, [](Commands&) {}); });
    std::vector<double> times;
    for (const FrameRecord& frame : loop.finish())
        times.push_back(frame.passes.front().milliseconds);
    std::ranges::nth_element(times, times.begin() + kFrames / 2);
    return times[kFrames / 2];
}

}  // namespace engine
