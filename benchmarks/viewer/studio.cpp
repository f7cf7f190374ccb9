#include "benchmarks/viewer/studio.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/error.h"
#include "engine/process.h"
#include "hair/fields.h"

namespace benchmarks::viewer {
namespace {

bool differInMoreThanCamera(hair::Settings a, const hair::Settings& b) {
    a.camera = b.camera;
    return hair::differ(a, b);
}

}  // namespace

Studio::Studio(
    const engine::Device& device, const std::filesystem::path& shaders,
    std::function<void()> before, measure::HairCache cache)
    : device_(device), before_(std::move(before)), cache_(std::move(cache)),
      reload_(device, shaders) {}

void Studio::reloadShaders() {
    if (!reload_.poll()) return;
    const auto rebuild = [&] {
        for (const auto& [side, played] : played_) played->player.rebuild();
    };
    try {
        rebuild();
        reload_.accept();
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        reload_.reject(error.what());
        rebuild();
    }
}

// ---- Settings -----------------------------------------------------------------------------------

// Creates a side that was not played before.
void Studio::make(const SideOrder& order, unsigned level, SideReply& reply) {
    try {
        auto played = std::make_unique<Played>(device_, order, order.directory, cache_, level);
        if (const auto beside = played_.find(order.beside.value_or(0)); beside != played_.end())
            played->player.seek(beside->second->player.frame());
        played->revision = order.revision;
        played_[order.side] = std::move(played);
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (...) {
        reply.failure = std::current_exception();
    }
}

void Studio::follow(Played& played, const SideOrder& order, SideReply& reply) {
    if (played.revision == order.revision) return;
    played.revision = order.revision;
    const hair::Settings before = played.player.settings();
    try {
        if (order.continues)
            played.player.preview(order.settings);
        else
            played.player.apply(order.settings);
        played.problem.clear();
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        played.problem = error.what();
    }
    reply.restarts_timings |= differInMoreThanCamera(before, played.player.settings());
}

// Keeps drawing the last valid text until there is a new one.
void Studio::reread(Played& played, SideReply& reply) {
    try {
        if (!played.player.reread()) return;
        played.problem.clear();
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        played.problem = error.what();
    }
    reply.reread = reply.restarts_timings = true;
}

// Removes sides that are no longer wanted, and creates new ones.
void Studio::admit(const Order& order, Reply& reply) {
    std::erase_if(played_, [&](const auto& entry) {
        return std::ranges::none_of(
            order.sides, [&](const SideOrder& side) { return side.side == entry.first; });
    });
    for (const SideOrder& side : order.sides) {
        reply.sides.push_back({.side = side.side, .revision = side.revision});
        if (played_.contains(side.side)) continue;
        make(side, order.level, reply.sides.back());
        // Counts only the time of its first frame, not of its creation.
        if (const auto made = played_.find(side.side); made != played_.end())
            reply.milliseconds += made->second->player.record().wall;
    }
}

// ---- Frames -------------------------------------------------------------------------------------

// Plays the frames that are due and draws the last one.
void Studio::advance(Player& player, const Order& order, const Stop& stop, SideReply& reply) {
    for (std::uint32_t frame = 0; frame < order.frames; ++frame) {
        if (frame + 1 < order.frames) {
            if (stop()) throw engine::Interrupted();
            player.skip();
            continue;
        }
        player.next(order.timing);
        if (order.level == 0)
            reply.timed = TimedFrame{player.record(), order.timing, player.frame()};
    }
    player.refresh();
}

void Studio::play(const Order& order, const Stop& stop, Reply& reply) {
    using Clock = std::chrono::steady_clock;
    for (std::size_t i = 0; i < reply.sides.size(); ++i) {
        SideReply& side = reply.sides[i];
        const auto found = played_.find(side.side);
        if (found == played_.end()) continue;
        Player& player = found->second->player;
        player.setLevel(order.level);
        const std::uint64_t before = player.pictures();
        reread(*found->second, side);
        follow(*found->second, order.sides[i], side);
        side.problem = found->second->problem;
        if (order.seek) player.seek(*order.seek, stop);
        const std::uint64_t there = player.pictures();
        if (there != before) reply.milliseconds += player.record().wall;
        const Clock::time_point start = Clock::now();
        advance(player, order, stop, side);
        if (player.pictures() != there)
            reply.milliseconds +=
                std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }
}

// ---- Facts about the sides ----------------------------------------------------------------------

void Studio::measure(const MeasureOrder& order, Reply& reply) {
    const auto found = played_.find(order.side);
    if (found == played_.end()) return;
    const Player& player = found->second->player;
    try {
        reply.measured =
            measureSide(device_, player.settings(), player.directory(), order.name, order.hooks);
    } catch (const engine::Interrupted&) {
        reply.not_measured = "Cancelled: nothing was measured.";
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        reply.not_measured = error.what();
    }
}

Reply Studio::perform(const Order& order, const Stop& stop) {
    if (before_) before_();
    Reply reply{.level = order.level};
    reloadShaders();
    admit(order, reply);
    try {
        play(order, stop, reply);
    } catch (const engine::Interrupted&) {
        // After a stop, nobody looks at the picture.
    }

    if (order.count)
        if (const auto found = played_.find(*order.count); found != played_.end())
            reply.counted = countStatistics(device_, found->second->player.played());
    if (order.measure) measure(*order.measure, reply);

    for (SideReply& side : reply.sides) {
        const auto found = played_.find(side.side);
        if (found == played_.end()) continue;
        Played& played = *found->second;
        // If there are many guides, they are sent late, with the first order without frames to
        // play.
        const bool moves = order.frames > 0;
        if (played.pictures == played.player.pictures() && (moves || !played.lacks_guides))
            continue;
        played.pictures = played.player.pictures();
        side.shown = played.player.shown(moves ? Player::Guides::few : Player::Guides::all);
        side.shown->number = ++replied_;
        played.lacks_guides = !side.shown->has_guides;
    }
    reply.shaders = reload_.status();
    reply.memory = device_.memory();
    return reply;
}

}  // namespace benchmarks::viewer
