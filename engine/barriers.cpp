#include "engine/barriers.h"

#include <algorithm>
#include <bit>

namespace engine {

// ---- Scopes -------------------------------------------------------------------------------------

namespace {

// Classes of stages that barriers tell apart.
enum Class : std::uint32_t {
    kCompute = 1u << 0,
    kVertex = 1u << 1,  // before the rasteriser
    kFragment = 1u << 2,
    kAttachment = 1u << 3,  // tests of depth, and colours
    kTransfer = 1u << 4,
    kIndirect = 1u << 5,
    kHost = 1u << 6,
    kBuild = 1u << 7,  // of acceleration structures
    kTrace = 1u << 8,  // ray queries of compute
    kFragmentTrace = 1u << 9,  // ray queries of the fragment stage
};

// The classes of a queue without graphics.
constexpr std::uint32_t kComputeQueue = kCompute | kTransfer | kHost;

struct ClassScope {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 reads;
    VkAccessFlags2 writes;
    std::uint32_t earlier;  // classes whose stages a draw completes before these
    std::uint32_t later;  // classes whose stages a draw starts after these
};

// In the order of the bits. The earlier and later stages are those of chapter 7.1.2 of the Vulkan
// specification. Depth is tested before fragments are shaded, and written before or after.
constexpr std::array<ClassScope, 10> kScopes{{
    {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT,
     VK_ACCESS_2_SHADER_WRITE_BIT, kTrace, kTrace},
    {VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, VK_ACCESS_2_SHADER_READ_BIT, 0, kIndirect,
     kFragment | kAttachment | kFragmentTrace},
    {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT,
     VK_ACCESS_2_SHADER_WRITE_BIT, kIndirect | kVertex | kFragmentTrace, kFragmentTrace},
    {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
         VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     kIndirect | kVertex | kFragment | kFragmentTrace, 0},
    {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
     VK_ACCESS_2_TRANSFER_WRITE_BIT, 0, 0},
    {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0, 0,
     kVertex | kFragment | kAttachment | kFragmentTrace},
    {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, VK_ACCESS_2_HOST_WRITE_BIT, 0, 0},
    {VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
     VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR,
     VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR, 0, 0},
    // The same stages as kCompute and kFragment, but no barrier may name this access on a device
    // without it.
    {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR, 0,
     kCompute, kCompute},
    {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR, 0,
     kIndirect | kVertex | kFragment, kFragment},
}};

struct ClassAccess {
    std::uint32_t classes;
    bool writes;
};

// In the order of the enumerators.
constexpr std::array<ClassAccess, 16> kAccesses{{
    {kCompute, false},  // compute_read
    {kCompute, true},  // compute_write
    {kVertex | kFragment, false},  // graphics_read
    {kIndirect, false},  // indirect_read
    {kVertex, false},  // vertex_read
    {kFragment, false},  // fragment_read
    {kFragment | kCompute, false},  // shading_read
    {kFragment, true},  // fragment_write
    {kAttachment, true},  // attachment
    {kTransfer, false},  // transfer_read
    {kTransfer, true},  // transfer_write
    {kHost, false},  // host_read
    {kBuild, false},  // build_read
    {kBuild, true},  // build_write
    {kTrace, false},  // trace_read
    {kFragmentTrace, false},  // fragment_trace
}};

constexpr const ClassAccess& classesOf(Access access) {
    return kAccesses[static_cast<std::size_t>(access)];
}

// Returns the classes that read or write an image in this layout.
std::uint32_t classesOf(VkImageLayout layout) {
    switch (layout) {
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
        return kAttachment;
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
        return kTransfer;
    case VK_IMAGE_LAYOUT_GENERAL:
        return kCompute;
    default:
        return kCompute | kFragment;
    }
}

template <class Function>
void forEach(std::uint32_t classes, Function&& function) {
    for (; classes != 0; classes &= classes - 1)
        function(static_cast<std::size_t>(std::countr_zero(classes)));
}

std::uint32_t classesWithEarlier(std::uint32_t classes) {
    std::uint32_t all = classes;
    forEach(classes, [&](std::size_t each) { all |= kScopes[each].earlier; });
    return all;
}

std::uint32_t classesWithLater(std::uint32_t classes) {
    std::uint32_t all = classes;
    forEach(classes, [&](std::size_t each) { all |= kScopes[each].later; });
    return all;
}

enum class Side { before, after };

Scope scopeOf(std::uint32_t classes, Side side) {
    Scope scope;
    forEach(classes, [&](std::size_t each) {
        scope.stages |= kScopes[each].stages;
        scope.access |= kScopes[each].writes;
        if (side == Side::after) scope.access |= kScopes[each].reads;
    });
    return scope;
}

}  // namespace

Scope scopeOf(Access access) {
    if (access == Access::graphics_read)
        return {
            VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT,
            VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT};
    const ClassAccess of = classesOf(access);
    Scope scope;
    forEach(of.classes, [&](std::size_t each) {
        scope.stages |= kScopes[each].stages;
        scope.access |= kScopes[each].reads | (of.writes ? kScopes[each].writes : 0);
    });
    // A transfer that writes reads nothing there.
    if (access == Access::transfer_write) scope.access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    return scope;
}

// ---- Resources ----------------------------------------------------------------------------------

TrackedResources::Entry TrackedResources::add(Resource resource) {
    auto id = static_cast<Id>(uses_.size());
    const std::uint64_t address = resource.address;
    if (free_.empty()) {
        uses_.emplace_back();
        resources_.push_back(std::move(resource));
    } else {
        id = free_.back();
        free_.pop_back();
        uses_[id] = {};
        resources_[id] = std::move(resource);
    }
    if (address != 0) buffers_[address] = id;
    return {*this, id};
}

void TrackedResources::remove(Id id) {
    const auto place = buffers_.find(resources_[id].address);
    if (place != buffers_.end() && place->second == id) buffers_.erase(place);
    resources_[id].exists = false;
    if (removed_)
        removed_(id);
    else
        free_.push_back(id);
}

std::optional<TrackedResources::Id> TrackedResources::bufferAt(std::uint64_t address) const {
    auto after = buffers_.upper_bound(address);
    if (after == buffers_.begin()) return std::nullopt;
    const auto& [first, id] = *--after;
    if (address - first >= resources_[id].bytes) return std::nullopt;
    return id;
}

MemoryLedger TrackedResources::memory() const {
    MemoryLedger ledger;
    for (const Resource& each : resources_)
        if (each.exists) ledger[each.memory] += each.allocated;
    return ledger;
}

std::map<std::string, std::uint64_t> TrackedResources::bytes() const {
    std::map<std::string, std::uint64_t> bytes;
    for (const Resource& each : resources_)
        if (each.exists) bytes[each.memory.name] += each.bytes;
    return bytes;
}

// ---- The plan -----------------------------------------------------------------------------------

TrackedResources::Uses& BarrierPlan::usesOf(TrackedResources::Id id) {
    return resources_.uses_[id][queue_];
}

void BarrierPlan::wait(std::size_t earlier, std::size_t later) {
    Pair& pair = ((kFragment | kAttachment | kFragmentTrace) >> earlier) & 1u ? drawing_ : shaders_;
    pair.before |= 1u << earlier;
    pair.after |= 1u << later;
}

void BarrierPlan::require(TrackedResources::Id id, Access access) {
    required_.push_back({id, access});
    // A change of layout in front of the same command comes after everything that was done before.
    if (std::ranges::find(changes_, id, [](const auto& change) { return change.first; }) !=
        changes_.end())
        return;
    const TrackedResources::Uses& uses = usesOf(id);
    const ClassAccess next = classesOf(access);
    forEach(next.classes, [&](std::size_t later) {
        if (uses.is_layout) {
            bool is_over = (uses.visible >> later) & 1u;
            forEach(uses.writer, [&](std::size_t earlier) {
                is_over = is_over || visible_[earlier][later] >= uses.written;
            });
            if (!is_over) forEach(uses.writer, [&](std::size_t earlier) { wait(earlier, later); });
        } else if (uses.written > 0) {
            forEach(uses.writer, [&](std::size_t earlier) {
                if (visible_[earlier][later] < uses.written) wait(earlier, later);
            });
        }
        if (!next.writes) return;
        for (std::size_t earlier = 0; earlier < kClasses; ++earlier)
            if (uses.read[earlier] > ordered_[earlier][later]) wait(earlier, later);
    });
}

void BarrierPlan::requireAgain() {
    for (const Required& required : last_) require(required.id, required.access);
}

void BarrierPlan::withdraw() {
    required_.clear();
    shaders_ = drawing_ = {};
}

void BarrierPlan::requireForRendering() {
    forEach(kCompute | kTransfer | kFragment, [&](std::size_t earlier) {
        forEach(kVertex | kFragment | kIndirect, [&](std::size_t later) {
            if (written_[earlier] > visible_[earlier][later]) wait(earlier, later);
        });
    });
}

void BarrierPlan::change(TrackedResources::Id image, VkImageLayout to) {
    const TrackedResources::Uses& uses = usesOf(image);
    if (uses.written > 0) layouts_.before |= uses.writer;
    for (std::size_t earlier = 0; earlier < kClasses; ++earlier)
        if (uses.read[earlier] > 0) layouts_.before |= 1u << earlier;
    layouts_.after |= classesOf(to);
    changes_.emplace_back(image, to);
}

std::optional<PlannedBarrier> BarrierPlan::take() {
    if (!isNeeded()) return std::nullopt;
    constexpr Classes kCheapBefore = kCompute | kTransfer | kTrace;
    constexpr Classes kCheapAfter = kCompute | kVertex | kFragment | kTransfer;
    const Classes needing = shaders_.after | drawing_.after | layouts_.after;
    const bool draws = (needing & ~(kComputeQueue | kBuild | kTrace)) != 0;
    forEach(draws ? kCheapBefore | kVertex : kCheapBefore, [&](std::size_t each) {
        if (used_[each] > ordered_[each][std::countr_zero(std::uint32_t{kCompute})])
            shaders_.before |= 1u << each;
    });
    if (shaders_.before != 0) shaders_.after |= kCheapAfter;
    if (queue_ == static_cast<std::size_t>(QueueKind::compute)) {
        shaders_.before &= kComputeQueue;
        shaders_.after &= kComputeQueue;
        drawing_ = {};
    }
    const Times ordered = ordered_;
    order(ordered, shaders_, Memory::all);
    order(ordered, drawing_, Memory::all);
    order(ordered, layouts_, Memory::of_images);
    for (const auto& [image, layout] : changes_) {
        TrackedResources::Uses& uses = usesOf(image);
        uses = {};
        uses.writer = classesOf(layout);
        uses.is_layout = true;
        uses.visible = layouts_.after;
        uses.written = now_;
    }
    ++now_;
    const auto planned = [](Pair pair) {
        return Dependency{scopeOf(pair.before, Side::before), scopeOf(pair.after, Side::after)};
    };
    const PlannedBarrier barrier{planned(shaders_), planned(drawing_), planned(layouts_)};
    forgetNeeds();
    changes_.clear();
    return barrier;
}

void BarrierPlan::forgetNeeds() { shaders_ = drawing_ = layouts_ = {}; }

// A barrier after a barrier forms a chain with it if the first one's later stages are among the
// second one's earlier stages. `ordered`: by the barriers before this one.
void BarrierPlan::order(const Times& ordered, Pair pair, Memory memory) {
    if (pair.before == 0) return;
    const Classes waited_for = classesWithEarlier(pair.before);
    const Classes waiting = classesWithLater(pair.after);
    if (memory == Memory::all)
        forEach(pair.before, [&](std::size_t each) { flushed_[each] = now_; });
    for (std::size_t first = 0; first < kClasses; ++first) {
        std::uint64_t chained = 0;
        forEach(waited_for, [&](std::size_t link) {
            chained = std::max(chained, ordered[first][link]);
        });
        if ((waited_for >> first) & 1u) chained = now_;
        forEach(waiting, [&](std::size_t last) {
            ordered_[first][last] = std::max(ordered_[first][last], chained);
        });
        if (memory == Memory::of_images) continue;
        const std::uint64_t available = std::min(chained, flushed_[first]);
        forEach(pair.after, [&](std::size_t last) {
            visible_[first][last] = std::max(visible_[first][last], available);
        });
    }
}

void BarrierPlan::commit() {
    if (required_.empty()) return;
    for (const Required& required : required_) {
        const ClassAccess access = classesOf(required.access);
        TrackedResources::Uses& uses = usesOf(required.id);
        if (access.writes) {
            uses = {};
            uses.writer = access.classes;
            uses.written = now_;
        } else {
            forEach(access.classes, [&](std::size_t each) { uses.read[each] = now_; });
        }
        forEach(access.classes, [&](std::size_t each) {
            used_[each] = now_;
            if (access.writes) written_[each] = now_;
        });
    }
    std::swap(required_, last_);
    required_.clear();
    forgetNeeds();
    ++now_;
}

void BarrierPlan::orderedAll() {
    for (std::size_t first = 0; first < kClasses; ++first) {
        ordered_[first].fill(now_);
        visible_[first].fill(now_);
    }
    flushed_.fill(now_);
    ++now_;
}

void BarrierPlan::forgetOrder() {
    ordered_ = {};
    visible_ = {};
    flushed_ = {};
    required_.clear();
    last_.clear();
    changes_.clear();
    forgetNeeds();
}

}  // namespace engine
