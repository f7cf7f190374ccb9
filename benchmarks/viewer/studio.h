#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/viewer/order_thread.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/shader_reload.h"
#include "benchmarks/viewer/timings.h"
#include "engine/device.h"

// Where the scene is played and drawn, on a thread and a device of its own: it takes orders and
// gives replies, both of them values.
namespace benchmarks::viewer {

// The runner's measurement of a side.
struct MeasureOrder {
    std::uint64_t side = 0;
    std::string name;  // of the scene
    // Called on the thread that measures.
    measure::MeasureHooks hooks;
};

// What the window asks for at once.
struct Order {
    std::vector<SideOrder> sides;  // all that there are to be: others go
    std::optional<std::uint32_t> seek;
    std::uint32_t frames = 0;  // to be played, the last of which is drawn
    engine::Timing timing = engine::Timing::isolated;
    unsigned level = 0;  // of preview.h
    std::optional<std::uint64_t> count;  // the side whose picture's work is to be counted
    std::optional<MeasureOrder> measure;
};

struct Reply {
    std::vector<SideReply> sides;
    unsigned level = 0;  // that was drawn
    // That playing and drawing took, and of frames on the way to another one, as after a seek, what
    // the last one took. 0: nothing was drawn.
    double milliseconds = 0.0;
    ShaderStatus shaders;
    engine::MemoryLedger memory;  // who holds what of the device's
    // Of sides whose number was asked for.
    std::optional<report::CaseResult> counted;
    std::optional<SideMeasurement> measured;
    std::string not_measured;  // why not, where it was asked for
};

// The players of all sides, and the shaders that are watched. One thread's at a time.
class Studio {
public:
    // `before`: called with each order before anything is done, for those who want to hold it up;
    // may be empty. `cache`: what sides have in common.
    Studio(
        const engine::Device& device, const std::filesystem::path& shaders,
        std::function<void()> before = {}, measure::HairCache cache = measure::HairCache());

    // Where it is asked to stop it ends between two frames, and has no picture of those that were
    // left out. Throws engine::DeviceLost; what else goes wrong is in the reply.
    Reply perform(const Order& order, const Stop& stop);

private:
    // A side, and which of its settings are played.
    struct Played {
        Played(
            const engine::Device& device, const SideOrder& order,
            const std::filesystem::path& directory, measure::HairCache& cache, unsigned level)
            : player(device, order.settings, directory, &cache, level) {}

        Player player;
        std::uint64_t revision = 0;  // that was followed or refused
        std::string problem;
        std::uint64_t pictures = 0;  // of the player's that were replied
        bool lacks_guides = false;  // what was replied
    };

    void reloadShaders();
    void admit(const Order& order, Reply& reply);
    void make(const SideOrder& order, unsigned level, SideReply& reply);
    static void reread(Played& played, SideReply& reply);
    static void follow(Played& played, const SideOrder& order, SideReply& reply);
    void play(const Order& order, const Stop& stop, Reply& reply);
    static void advance(Player& player, const Order& order, const Stop& stop, SideReply& reply);
    void measure(const MeasureOrder& order, Reply& reply);

    const engine::Device& device_;
    std::function<void()> before_;
    measure::HairCache cache_;
    ShaderReload reload_;
    std::map<std::uint64_t, std::unique_ptr<Played>> played_;  // by the side's number
    std::uint64_t replied_ = 0;  // pictures
};

}  // namespace benchmarks::viewer
