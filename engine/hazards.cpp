#include "engine/hazards.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "engine/instance.h"

namespace engine {
namespace {

// ---- Stages and accesses ------------------------------------------------------------------------

// Stages of a draw in pipeline order: of vertex draws, and of mesh draws.
constexpr std::array<VkPipelineStageFlags2, 10> kVertexDraw{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
    VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
    VK_PIPELINE_STAGE_2_TESSELLATION_CONTROL_SHADER_BIT,
    VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT,
    VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT};
constexpr std::array<VkPipelineStageFlags2, 7> kMeshDraw{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,          VK_PIPELINE_STAGE_2_TASK_SHADER_BIT_EXT,
    VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT,        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,        VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT};

constexpr VkPipelineStageFlags2 allGraphics() {
    VkPipelineStageFlags2 stages = 0;
    for (const VkPipelineStageFlags2 stage : kVertexDraw) stages |= stage;
    for (const VkPipelineStageFlags2 stage : kMeshDraw) stages |= stage;
    return stages;
}

constexpr VkPipelineStageFlags2 kTransferStages =
    VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT |
    VK_PIPELINE_STAGE_2_CLEAR_BIT;

// Pseudo-stage of layout changes, which happen between two stages. No barrier names it.
constexpr VkPipelineStageFlags2 kBetweenStages = VkPipelineStageFlags2{1} << 63;

constexpr VkAccessFlags2 kReads =
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT |
    VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_READ_BIT |
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
    VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_HOST_READ_BIT |
    VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
constexpr VkAccessFlags2 kWrites =
    VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
    VK_ACCESS_2_HOST_WRITE_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;

// Expands groups of stages and accesses into their members.
Scope expanded(Scope scope) {
    const auto expand = [](auto& flags, auto group, auto members) {
        if ((flags & group) == group) flags = (flags & ~group) | members;
    };
    constexpr VkPipelineStageFlags2 kBeforeRaster =
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
        VK_PIPELINE_STAGE_2_TESSELLATION_CONTROL_SHADER_BIT |
        VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT |
        VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT | VK_PIPELINE_STAGE_2_TASK_SHADER_BIT_EXT |
        VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT;
    expand(
        scope.stages, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        allGraphics() | kTransferStages | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
            VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR |
            VK_PIPELINE_STAGE_2_HOST_BIT);
    expand(scope.stages, VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, allGraphics());
    expand(scope.stages, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, kTransferStages);
    expand(scope.stages, VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, kBeforeRaster);
    expand(scope.access, VK_ACCESS_2_MEMORY_READ_BIT, kReads);
    expand(scope.access, VK_ACCESS_2_MEMORY_WRITE_BIT, kWrites);
    return scope;
}

using Stages = std::span<const VkPipelineStageFlags2>;

// Returns the stages of a draw before the last of `stages`.
VkPipelineStageFlags2 earlierOf(Stages draw, VkPipelineStageFlags2 stages) {
    VkPipelineStageFlags2 earlier = 0;
    VkPipelineStageFlags2 result = 0;
    for (const VkPipelineStageFlags2 stage : draw) {
        if (stages & stage) result |= earlier;
        earlier |= stage;
    }
    return result;
}

// Returns the stages of a draw after the first of `stages`.
VkPipelineStageFlags2 laterOf(Stages draw, VkPipelineStageFlags2 stages) {
    VkPipelineStageFlags2 result = 0;
    bool reached = false;
    for (const VkPipelineStageFlags2 stage : draw) {
        if (reached) result |= stage;
        reached = reached || (stages & stage);
    }
    return result;
}

// Adds the earlier stages of a draw, which a barrier waits for too.
VkPipelineStageFlags2 withEarlier(VkPipelineStageFlags2 stages) {
    return stages | earlierOf(kVertexDraw, stages) | earlierOf(kMeshDraw, stages);
}

// Adds the later stages of a draw, which wait for a barrier too.
VkPipelineStageFlags2 withLater(VkPipelineStageFlags2 stages) {
    return stages | laterOf(kVertexDraw, stages) | laterOf(kMeshDraw, stages);
}

bool isWithin(VkFlags64 part, VkFlags64 whole) { return (part & ~whole) == 0; }

// Whether a write made visible to `visible` is visible to all stages and accesses of `scope`.
bool isVisibleTo(const std::vector<Scope>& visible, const Scope& scope) {
    for (VkPipelineStageFlags2 left = scope.stages; left; left &= left - 1) {
        const VkPipelineStageFlags2 stage = left & ~(left - 1);
        VkAccessFlags2 seen = 0;
        for (const Scope& each : visible)
            if (each.stages & stage) seen |= each.access;
        if (!isWithin(scope.access, seen)) return false;
    }
    return true;
}

const char* textOf(Hazard::Kind kind) {
    switch (kind) {
    case Hazard::Kind::read_after_write:
        return "read after write";
    case Hazard::Kind::write_after_read:
        return "write after read";
    case Hazard::Kind::write_after_write:
        break;
    }
    return "write after write";
}

}  // namespace

// ---- The rules ----------------------------------------------------------------------------------

std::vector<Hazard> HazardChecker::submit(const Recording& recording, QueueKind queue) {
    ++submissions_;
    queue_ = queue;
    std::vector<Hazard> found;
    for (const Recorded& each : recording) {
        apply(each.barriers, each.pass, found);
        apply(each.uses, each.pass, found);
    }
    return found;
}

void HazardChecker::finish(std::uint64_t submission) {
    forgetIf([&](const Done& done) { return done.submission <= submission; });
}

void HazardChecker::waitFor(std::uint64_t submission) {
    forgetIf([&](const Done& done) { return done.submission == submission; });
}

void HazardChecker::forgetIf(const std::function<bool(const Done&)>& is_over) {
    for (auto& [resource, state] : states_) {
        if (state.write && is_over(*state.write)) state.write.reset();
        std::erase_if(state.reads, is_over);
    }
    std::erase_if(states_, [](const auto& entry) {
        return !entry.second.write && entry.second.reads.empty();
    });
}

void HazardChecker::apply(
    const std::vector<RecordedBarrier>& barriers, const std::string& pass,
    std::vector<Hazard>& found) {
    const auto comesBefore = [&](const RecordedBarrier& barrier, const Done& done) {
        if (done.queue != queue_) return false;
        const VkPipelineStageFlags2 waited_for = withEarlier(expanded(barrier.before).stages);
        return isWithin(done.scope.stages, waited_for) || (done.ordered & waited_for);
    };
    for (auto& [resource, state] : states_) {
        if (state.write) {
            const Done before = *state.write;
            for (const RecordedBarrier& barrier : barriers) {
                if (!comesBefore(barrier, before)) continue;
                const Scope from = expanded(barrier.before);
                const Scope to = expanded(barrier.after);
                const bool is_meant = !barrier.image || barrier.image == resource;
                const bool flushes = isWithin(before.scope.stages, from.stages) &&
                                     isWithin(before.scope.access & kWrites, from.access);
                if (is_meant && (before.available || flushes)) {
                    state.write->available = true;
                    state.write->visible.push_back(to);
                }
                state.write->ordered |= withLater(to.stages);
            }
        }
        for (Done& read : state.reads) {
            const Done before = read;
            for (const RecordedBarrier& barrier : barriers)
                if (comesBefore(barrier, before))
                    read.ordered |= withLater(expanded(barrier.after).stages);
        }
    }
    for (const RecordedBarrier& barrier : barriers)
        if (barrier.transitions_layout) transitionLayout(barrier, pass, found);
}

// A layout change comes after everything its barrier waits for, and before everything that waits
// for the barrier.
void HazardChecker::transitionLayout(
    const RecordedBarrier& barrier, const std::string& pass, std::vector<Hazard>& found) {
    const Scope before = expanded(barrier.before);
    const Scope after = expanded(barrier.after);
    const VkPipelineStageFlags2 waited_for = withEarlier(before.stages);
    const auto comesBefore = [&](const Done& done) {
        if (done.queue != queue_) return false;
        return isWithin(done.scope.stages, waited_for) || (done.ordered & waited_for);
    };
    State& state = states_[*barrier.image];
    if (state.write && !(comesBefore(*state.write) && state.write->available))
        found.push_back({Hazard::Kind::write_after_write, *barrier.image, state.write->pass, pass});
    for (const Done& read : state.reads)
        if (!comesBefore(read))
            found.push_back({Hazard::Kind::write_after_read, *barrier.image, read.pass, pass});
    state.reads.clear();
    state.write = Done{
        .scope = {kBetweenStages, 0},
        .pass = pass,
        .submission = submissions_,
        .queue = queue_,
        .ordered = withLater(after.stages),
        .available = true,
        .visible = {after}};
}

void HazardChecker::apply(
    const std::vector<RecordedUse>& uses, const std::string& pass, std::vector<Hazard>& found) {
    for (const RecordedUse& use : uses) {
        const Scope scope = expanded(use.scope);
        const Scope reads{scope.stages, scope.access & kReads};
        const Scope writes{scope.stages, scope.access & kWrites};
        State& state = states_[use.resource];
        const auto isVisible = [&](const Scope& later) {
            return state.write->queue == queue_ && isVisibleTo(state.write->visible, later);
        };
        if (state.write && reads.access && !isVisible(reads))
            found.push_back(
                {Hazard::Kind::read_after_write, use.resource, state.write->pass, pass});
        else if (state.write && writes.access && !isVisible(writes))
            found.push_back(
                {Hazard::Kind::write_after_write, use.resource, state.write->pass, pass});
        if (writes.access)
            for (const Done& read : state.reads)
                if (read.queue != queue_ || !isWithin(scope.stages, read.ordered))
                    found.push_back(
                        {Hazard::Kind::write_after_read, use.resource, read.pass, pass});

        const Done done{.scope = scope, .pass = pass, .submission = submissions_, .queue = queue_};
        if (writes.access) {
            state.reads.clear();
            state.write = done;
            continue;
        }
        // A use after the later of two reads by the same stages comes after both.
        const auto same = std::ranges::find_if(
            state.reads, [&](const Done& read) { return read.scope.stages == scope.stages; });
        if (same != state.reads.end())
            *same = done;
        else
            state.reads.push_back(done);
    }
}

std::set<std::string> barrierPlaces(std::span<const Recording> recordings) {
    std::set<std::string> places;
    for (const Recording& recording : recordings)
        for (const Recorded& each : recording)
            if (std::ranges::none_of(each.barriers, &RecordedBarrier::transitions_layout))
                for (const RecordedBarrier& barrier : each.barriers) places.insert(barrier.place);
    return places;
}

std::vector<std::string> redundantBarriers(std::span<const Recording> recordings) {
    // Counts the hazards without the barriers of one place.
    const auto hazardsWithout = [&](const std::string& place) {
        HazardChecker checker;
        std::size_t count = 0;
        for (const Recording& recording : recordings) {
            Recording left = recording;
            for (Recorded& each : left)
                std::erase_if(each.barriers, [&](const RecordedBarrier& barrier) {
                    return !barrier.transitions_layout && barrier.place == place;
                });
            count += checker.submit(left).size();
        }
        return count;
    };
    const std::size_t anyway = hazardsWithout("");
    std::vector<std::string> redundant;
    for (const std::string& place : barrierPlaces(recordings))
        if (hazardsWithout(place) <= anyway) redundant.push_back(place);
    return redundant;
}

// ---- Buffers and images -------------------------------------------------------------------------

HazardLog::HazardLog(MessageLog& messages, TrackedResources& resources)
    : messages_(messages), resources_(resources) {
    resources_.watch([this](ResourceId id) {
        checker_.forget(id);
        uses_.erase(id);
    });
}

namespace {

// Calls `use` with every number in the bytes that may be an address. Shared structs align addresses
// to 8 bytes.
template <class Use>
void forEachAddress(std::span<const std::byte> bytes, Use&& use) {
    for (std::size_t at = 0; at + sizeof(std::uint64_t) <= bytes.size();
         at += sizeof(std::uint64_t)) {
        std::uint64_t address = 0;
        std::memcpy(&address, bytes.data() + at, sizeof address);
        if (address != 0) use(address);
    }
}

}  // namespace

std::vector<ResourceId> HazardLog::hostBuffersIn(std::span<const std::byte> bytes) const {
    std::vector<ResourceId> found;
    const auto add = [&](std::uint64_t address) {
        const std::optional<ResourceId> id = resources_.bufferAt(address);
        if (!id || resources_.at(*id).mapped.empty()) return;
        if (std::ranges::find(found, *id) == found.end()) found.push_back(*id);
    };
    forEachAddress(bytes, add);
    for (std::size_t i = 0; i < found.size(); ++i)
        forEachAddress(resources_.at(found[i]).mapped, add);
    return found;
}

std::vector<ResourceId> HazardLog::writtenBuffersIn(std::span<const std::byte> bytes) const {
    std::vector<ResourceId> found;
    forEachAddress(bytes, [&](std::uint64_t address) {
        const std::optional<ResourceId> id = resources_.bufferAt(address);
        if (!id) return;
        const auto uses = uses_.find(*id);
        if (uses != uses_.end() && uses->second.written) found.push_back(*id);
    });
    return found;
}

// ---- Submissions --------------------------------------------------------------------------------

void HazardLog::submit(Recording recording, QueueKind queue) {
    ++submissions_;
    for (const Recorded& each : recording)
        for (const RecordedUse& use : each.uses) {
            Uses& uses = uses_[use.resource];
            uses.last_submission = submissions_;
            if (!each.pass.empty() && (expanded(use.scope).access & kWrites)) uses.written = true;
        }
    const auto passText = [](const std::string& pass) {
        return pass.empty() ? std::string("set-up") : "pass '" + pass + "'";
    };
    for (const Hazard& hazard : checker_.submit(recording, queue))
        report(
            std::string(textOf(hazard.kind)) + " of '" + name(hazard.resource) +
            "': " + passText(hazard.later) + " is not ordered after " + passText(hazard.earlier));
    if (keeps_recordings_) recordings_.push_back(std::move(recording));
}

std::vector<PassUses> HazardLog::passesOf(const Recording& recording) const {
    std::vector<PassUses> passes;
    for (const Recorded& each : recording) {
        if (each.pass.empty()) continue;
        auto pass = std::ranges::find(passes, each.pass, &PassUses::pass);
        if (pass == passes.end()) pass = passes.insert(pass, {.pass = each.pass});
        if (!each.barriers.empty()) ++pass->barriers;
        for (const RecordedUse& use : each.uses) {
            const bool writes = expanded(use.scope).access & kWrites;
            (writes ? pass->writes : pass->reads).insert(name(use.resource));
        }
    }
    for (PassUses& pass : passes)
        std::erase_if(pass.reads, [&](const auto& name) { return pass.writes.contains(name); });
    return passes;
}

void HazardLog::finish(std::uint64_t submission) {
    finished_ = std::max(finished_, submission);
    checker_.finish(submission);
}

void HazardLog::hostWrites(ResourceId id) {
    const auto uses = uses_.find(id);
    if (uses != uses_.end() && uses->second.last_submission > finished_)
        report(
            "write after read of '" + name(id) +
            "': the host writes data that a frame in flight may still read");
}

void HazardLog::complain(const std::string& pass, const std::string& what) {
    report("pass '" + pass + "': " + what);
}

void HazardLog::report(const std::string& message) {
    if (reported_.insert(message).second) messages_.add("hazard: " + message);
}

// ---- Dropped barriers ---------------------------------------------------------------------------

void HazardLog::drop(std::optional<std::uint32_t> index) {
    drop_ = index;
    dropped_.reset();
    barriers_ = 0;
    reported_.clear();
}

bool HazardLog::isDropped(const std::string& pass, const std::string& place) {
    const bool is_it = drop_ == barriers_++;
    if (is_it) dropped_ = pass + " " + place;
    return is_it;
}

}  // namespace engine
