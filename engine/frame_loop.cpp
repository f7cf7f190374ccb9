#include "engine/frame_loop.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <new>
#include <span>

namespace engine {

// ---- Memory of recordings -----------------------------------------------------------------------

namespace {

constexpr std::size_t kSlabBytes = 1 << 16;

}  // namespace

void* RecordingMemory::allocate(
    void* self, std::size_t size, std::size_t alignment, VkSystemAllocationScope) {
    auto& memory = *static_cast<RecordingMemory*>(self);
    const std::size_t units = (sizeof(Header) + size + kUnit - 1) / kUnit;
    const auto kind = static_cast<std::size_t>(std::bit_width(units - 1));
    if (kind >= kKinds || alignment > alignof(Header)) return allocateAlone(size, alignment);
    if (!memory.free_[kind] && !memory.addBlocks(kind)) return nullptr;
    Header* const block = memory.free_[kind];
    memory.free_[kind] = static_cast<Header*>(block->place);
    block->size = size;
    return block + 1;
}

void* RecordingMemory::allocateAlone(std::size_t size, std::size_t alignment) {
    std::size_t space = size + alignment;
    auto* const place = static_cast<std::byte*>(std::malloc(sizeof(Header) + space));
    if (!place) return nullptr;
    void* given = place + sizeof(Header);
    std::align(alignment, size, given, space);
    new (&headerOf(given)) Header{place, size, kKinds};
    return given;
}

bool RecordingMemory::addBlocks(std::size_t kind) {
    try {
        slabs_.push_back(std::make_unique_for_overwrite<std::byte[]>(kSlabBytes));
    } catch (const std::bad_alloc&) {
        return false;
    }
    const std::size_t step = kUnit << kind;
    for (std::size_t end = kSlabBytes; end > 0; end -= step)
        free_[kind] = new (slabs_.back().get() + end - step) Header{free_[kind], 0, kind};
    return true;
}

void* RecordingMemory::reallocate(
    void* self, void* given, std::size_t size, std::size_t alignment,
    VkSystemAllocationScope scope) {
    if (size == 0) {
        release(self, given);
        return nullptr;
    }
    void* const made = allocate(self, size, alignment, scope);
    if (given && made) {
        std::memcpy(made, given, std::min(size, headerOf(given).size));
        release(self, given);
    }
    return made;
}

void RecordingMemory::release(void* self, void* given) {
    if (!given) return;
    Header& header = headerOf(given);
    if (header.kind == kKinds) return std::free(header.place);
    Header*& first = static_cast<RecordingMemory*>(self)->free_[header.kind];
    header.place = std::exchange(first, &header);
}

// ---- Frames in flight ---------------------------------------------------------------------------

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kMaxTimestamps = 1024;

constexpr std::size_t kRecordsAtFirst = 64;  // frames

double millisecondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

void addTime(std::vector<PassTime>& passes, const PassTime& time) {
    const auto found = std::ranges::find(passes, time.name, &PassTime::name);
    if (found != passes.end()) {
        found->milliseconds += time.milliseconds;
        found->use = found->use + time.use;
        ++found->parts;
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

}  // namespace

void Passes::asyncCompute(std::uint32_t, FunctionRef<void()> record) { record(); }

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
        if (async) async_buffer.emplace(device, device.info().compute_family);
        const bool timestamped = timing == Timing::overlapped || timing == Timing::isolated;
        if (timestamped && device.info().timestamp_valid_bits > 0) {
            timestamps.emplace(device, kMaxTimestamps);
        }
    }

    struct Span {
        std::string name;
        std::uint32_t first_timestamp;
        std::uint32_t last_timestamp;
    };
    struct Query {
        std::string name;
        PipelineStatistics statistics;
    };

    std::optional<OwnBuffer> async_buffer;  // for the second queue
    std::optional<Timestamps> timestamps;
    std::vector<Span> spans;
    std::vector<Query> queries;
    std::uint64_t value = 0;  // timeline value that marks the slot's frame as done
    std::uint64_t submission = 0;  // HazardLog submission number
    std::optional<std::size_t> record;  // index of the record still to be read
};

// Overlapped, isolated and statistics frames: all passes share one command buffer, except those for
// the second queue.
class FrameLoop::OneBufferPasses : public Passes {
public:
    // `async`: records for the second queue; null: everything goes to the first.
    OneBufferPasses(
        const Device& device, Timing timing, TimestampPlacement placement, Slot& slot,
        std::uint32_t index, Commands& commands, Commands* async)
        : device_(device), timing_(timing), placement_(placement), slot_data_(slot),
          commands_(&commands), async_(async) {
        slot_ = index;
        if (timing_ == Timing::overlapped && slot_data_.timestamps)
            slot_data_.timestamps->write(*commands_);
    }

    void pass(const char* name, PassKind kind, FunctionRef<void(Commands&)> record) override {
        commands_->beginLabel(name);
        if (timing_ == Timing::overlapped) {
            record(*commands_);
            if (slot_data_.timestamps && placement_ != TimestampPlacement::frame) {
                const std::uint32_t timestamp = slot_data_.timestamps->write(*commands_);
                slot_data_.spans.push_back({name, timestamp - 1, timestamp});
            }
        } else if (timing_ == Timing::isolated) {
            auto& stamps = slot_data_.timestamps;
            const std::uint32_t first = stamps ? stamps->write(*commands_) : 0;
            commands_->orderAll();
            record(*commands_);
            commands_->orderAll();
            if (stamps) slot_data_.spans.push_back({name, first, stamps->write(*commands_)});
        } else if (kind != PassKind::compute && device_.hasPipelineStatistics()) {
            const DrawnFrom drawn_from =
                kind == PassKind::meshes ? DrawnFrom::meshes : DrawnFrom::vertices;
            auto& query =
                slot_data_.queries.emplace_back(name, PipelineStatistics(device_, drawn_from));
            query.statistics.begin(*commands_);
            record(*commands_);
            query.statistics.end(*commands_);
        } else {
            record(*commands_);
        }
        commands_->endLabel();
        if (commands_ != async_) drawing_ = true;
    }

    bool joins() const override {
        return timing_ == Timing::overlapped && placement_ == TimestampPlacement::frame;
    }

    void asyncCompute(std::uint32_t frames, FunctionRef<void()> record) override {
        if (!async_) return record();
        assert(!drawing_);
        least_ = std::min(least_.value_or(frames), frames);
        Commands* const others = std::exchange(commands_, async_);
        record();
        commands_ = others;
    }

    // Frames that all passes recorded by asyncCompute() may overlap; absent: there are none.
    std::optional<std::uint32_t> asyncFrames() const { return least_; }

    void end() {
        if (timing_ == Timing::overlapped && placement_ == TimestampPlacement::frame &&
            slot_data_.timestamps)
            slot_data_.timestamps->write(*commands_);
    }

private:
    const Device& device_;
    Timing timing_;
    TimestampPlacement placement_;
    Slot& slot_data_;
    Commands* commands_;
    Commands* async_;
    bool drawing_ = false;
    std::optional<std::uint32_t> least_;
};

// Wall-clock frames: one submission per pass.
class FrameLoop::SubmittedPasses : public Passes {
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
        commands.orderAll();
        record(commands);
        commands.orderAll();
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

FrameLoop::FrameLoop(const Device& device, Timing timing, const Overlap& overlap)
    : device_(device), timing_(timing), placement_(overlap.timestamps),
      timeline_(makeTimeline(device.get())) {
    assert(overlap.frames > 0 && overlap.frames <= kMaxSlots);
    const std::uint32_t count = timing == Timing::overlapped ? overlap.frames : 1;
    const bool async = timing == Timing::overlapped && overlap.async;
    assert(!async || overlap.timestamps == TimestampPlacement::frame);
    for (std::uint32_t i = 0; i < count; ++i) {
        slots_.push_back(std::make_unique<Slot>(device, timing, async));
    }
    if (async) async_timeline_ = makeTimeline(device.get());
    records_.reserve(kRecordsAtFirst);
    ends_.reserve(kRecordsAtFirst);
}

FrameLoop::~FrameLoop() {
    try {
        waitFor(device_, timeline_.get(), submitted_);
        if (submitted_async_ > 0) waitFor(device_, async_timeline_.get(), submitted_async_);
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
    ends_.emplace_back();

    if (timing_ == Timing::wall_clock) {
        SubmittedPasses passes(device_, slot, timeline_.get(), submitted_, result);
        record(passes);
        result.use = processUse() - used;
        return;
    }

    if (slot.timestamps) slot.timestamps->reset();
    slot.spans.clear();
    slot.queries.clear();
    Commands commands(slot.buffer, slot.sets, device_.hazards());
    std::optional<Commands> async;
    if (slot.async_buffer)
        async.emplace(
            slot.async_buffer->buffer, slot.async_buffer->sets, device_.hazards(),
            QueueKind::compute);
    commands.begin();
    if (async) async->begin();
    OneBufferPasses passes(
        device_, timing_, placement_, slot, index, commands, async ? &*async : nullptr);
    record(passes);
    passes.end();
    const std::uint64_t drawn =
        submitted_ - std::min<std::uint64_t>(submitted_, passes.asyncFrames().value_or(0));
    if (async) endAsync(*async, drawn);
    commands.end();
    if (device_.hazards()) slot.submission = device_.hazards()->submissions();
    const Clock::time_point recorded = Clock::now();
    slot.value = submitted_ + 1;
    slot.record = records_.size() - 1;
    if (async && device_.hazards()) drawn_[slot.value] = slot.submission;
    // Counted only after submission succeeded: nobody waits for what is not submitted.
    if (passes.asyncFrames()) {
        submit(
            device_.computeQueue(), slot.async_buffer->buffer,
            {async_timeline_.get(), submitted_async_ + 1}, {timeline_.get(), drawn});
        ++submitted_async_;
    }
    submit(
        device_.queue(), slot.buffer, {timeline_.get(), slot.value},
        {async_timeline_.get(), submitted_async_});
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
void FrameLoop::endAsync(Commands& async, std::uint64_t drawn) {
    HazardLog* const hazards = device_.hazards();
    if (hazards) {
        const auto end = drawn_.upper_bound(drawn);
        for (auto each = drawn_.begin(); each != end; ++each) hazards->waitFor(each->second);
        drawn_.erase(drawn_.begin(), end);
    }
    async.end();
    if (hazards) hazards->waitFor(hazards->submissions());
}

std::vector<FrameRecord> FrameLoop::finish() {
    for (const auto& slot : slots_) collect(*slot);
    if (!records_.empty()) records_.back().interval = millisecondsBetween(start_, Clock::now());
    return takeRecords();
}

// Sets the gaps of the oldest records, which are complete and leave.
void FrameLoop::setGaps(std::span<FrameRecord> records) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (last_ends_ && ends_[i]) records[i].gap = millisecondsBetween(*last_ends_, *ends_[i]);
        last_ends_ = ends_[i];
    }
    ends_.erase(ends_.begin(), ends_.begin() + static_cast<std::ptrdiff_t>(records.size()));
}

// Takes all records, and reserves as many for the next batch.
std::vector<FrameRecord> FrameLoop::takeRecords() {
    setGaps(records_);
    std::vector<FrameRecord> next;
    next.reserve(std::max(records_.size(), kRecordsAtFirst));
    ends_.reserve(next.capacity());
    return std::exchange(records_, std::move(next));
}

std::vector<FrameRecord> FrameLoop::completed() {
    std::size_t count = records_.empty() ? 0 : records_.size() - 1;
    for (const auto& slot : slots_)
        if (slot->record) count = std::min(count, *slot->record);
    setGaps(std::span(records_).first(count));
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
    if (slot.timestamps) {
        const std::span<const double> times = slot.timestamps->read();
        for (const Slot::Span& span : slot.spans) {
            addTime(
                record.passes, {span.name, times[span.last_timestamp] - times[span.first_timestamp],
                                ProcessUse{}});
        }
        if (!times.empty()) {
            record.device = times.back();
            ends_[*slot.record] = slot.timestamps->ends();
        }
    }
    slot.record.reset();
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
