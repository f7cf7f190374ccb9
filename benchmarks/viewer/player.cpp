#include "benchmarks/viewer/player.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/device.h"

namespace benchmarks::viewer {
namespace {

// What a change of settings affects.
enum class Effect {
    none,
    camera,
    drawing,
    forces,  // what a running simulation can take
    everything,
};

Effect effectOf(const hair::Settings& before, const hair::Settings& after) {
    scene::Json a = scene::writeSettings(before), b = scene::writeSettings(after);
    const auto without = [&](const char* member) {
        a.erase(member);
        b.erase(member);
        return a == b;
    };
    if (without("description")) return Effect::none;
    for (const char* member : {"groom", "seed", "run"})
        if (a[member] != b[member]) return Effect::everything;
    if (a["simulation"] != b["simulation"]) {
        for (scene::Json* document : {&a, &b})
            for (const char* member : {"wind", "colliders", "motion", "pulls"})
                (*document)["simulation"].erase(member);
        return a["simulation"] == b["simulation"] ? Effect::forces : Effect::everything;
    }
    return without("camera") ? Effect::camera : Effect::drawing;
}

scene::Document documentOf(const hair::Settings& settings) {
    return scene::Document(scene::writeSettings(settings));
}

bool sameButCamera(hair::Settings a, const hair::Settings& b) {
    a.camera = b.camera;
    return documentOf(a) == documentOf(b);
}

constexpr double kPause = 0.5;  // s without a new frame: longer than a slow device takes for one

}  // namespace

// ---- Pacer --------------------------------------------------------------------------------------

std::uint32_t Pacer::framesFor(double seconds, double frame_time, std::optional<double> speed) {
    if (!speed) {
        due_ = 0.0;
        return 1;
    }
    if (frame_time <= 0.0) return 0;
    due_ = std::min(due_ + seconds * *speed / frame_time, double{kMostFrames});
    const double whole = std::floor(due_);
    due_ -= whole;
    return static_cast<std::uint32_t>(whole);
}

// ---- Player -------------------------------------------------------------------------------------

Player::Player(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory)
    : device_(device), directory_(directory), settings_(settings),
      case_(std::make_unique<measure::Case>(device, settings, directory)),
      isolated_(device, engine::Timing::isolated), overlapped_(device, engine::Timing::overlapped) {
    seek(0);
}

double Player::time() const {
    return (static_cast<double>(frame_) + 1.0) * double{settings_.run.frame_time};
}

void Player::apply(const hair::Settings& settings) {
    const Effect effect = effectOf(settings_, settings);
    if (effect == Effect::none && !previews_) return;
    scene::checkSettings(settings);
    if (effect == Effect::forces || effect == Effect::everything || previews_) {
        replace(std::make_unique<measure::Case>(device_, settings, directory_), settings);
        return;
    }
    drawWith(settings);
}

void Player::preview(const hair::Settings& settings) {
    const Effect effect = effectOf(settings_, settings);
    if (effect == Effect::none || effect == Effect::everything) return;
    scene::checkSettings(settings);
    if (effect == Effect::forces) {
        case_->carryOn(settings.simulation);
        settings_.simulation = settings.simulation;
        previews_ = true;
        return;
    }
    drawWith(settings);
}

// Draws the same frame with other settings.
void Player::drawWith(const hair::Settings& settings) {
    if (effectOf(settings_, settings) == Effect::camera)
        case_->setCamera(settings.camera);
    else
        case_->setDrawing(settings);
    settings_ = settings;
    redraw();
}

void Player::rebuild() {
    replace(std::make_unique<measure::Case>(device_, settings_, directory_), settings_);
}

void Player::replace(std::unique_ptr<measure::Case> other, const hair::Settings& settings) {
    case_ = std::move(other);
    settings_ = settings;
    seek(frame_);
}

void Player::play(engine::Timing timing, const std::function<void(engine::Passes&)>& record) {
    engine::FrameLoop& loop = timing == engine::Timing::overlapped ? overlapped_ : isolated_;
    loop.frame(record);
    record_ = loop.finish().back();
}

void Player::next(engine::Timing timing) {
    // What was submitted before, such as a picture of the window, is in none of the frame's times.
    device_.runOnce([](engine::Commands&) {});
    play(timing, [&](engine::Passes& passes) { case_->frame(passes); });
    ++frame_;
}

void Player::skip() {
    play(engine::Timing::isolated, [&](engine::Passes& passes) { case_->simulate(passes); });
    ++frame_;
}

void Player::redraw() {
    play(engine::Timing::isolated, [&](engine::Passes& passes) { case_->draw(passes); });
}

void Player::seek(std::uint32_t frame) {
    // What a preview's simulation would be reset to is of the settings before.
    if (std::exchange(previews_, false))
        case_ = std::make_unique<measure::Case>(device_, settings_, directory_);
    else
        case_->reset();
    frame_ = 0;
    while (frame_ < frame) skip();
    play(engine::Timing::isolated, [&](engine::Passes& passes) { case_->frame(passes); });
}

// ---- Edit history -------------------------------------------------------------------------------

EditHistory::EditHistory(scene::Document document) { documents_.push_back(std::move(document)); }

void EditHistory::edit(scene::Document document, bool continues) {
    const bool replaces = continues && continuing_;
    if (!replaces && document == current()) return;
    continuing_ = continues;
    if (replaces) {
        documents_[index_] = std::move(document);
        return;
    }
    documents_.resize(index_ + 1);
    documents_.push_back(std::move(document));
    ++index_;
}

const scene::Document& EditHistory::undo() {
    if (canUndo()) --index_;
    continuing_ = false;
    return current();
}

const scene::Document& EditHistory::redo() {
    if (canRedo()) ++index_;
    continuing_ = false;
    return current();
}

// ---- Side ---------------------------------------------------------------------------------------

Side::Side(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory)
    : wanted_(settings), original_(settings), history_(documentOf(settings)),
      player_(device, settings, directory) {}

void Side::edit(const hair::Settings& settings, Edit edit) {
    if (!edit.changed) return;
    wanted_ = settings;
    history_.edit(documentOf(settings), edit.continues);
    continues_ = edit.continues;
    follows_ = false;
}

void Side::settle() {
    history_.settle();
    if (!continues_) return;
    continues_ = false;
    follows_ = false;
}

void Side::undo() {
    wanted_ = scene::readSettings(history_.undo().json());
    continues_ = follows_ = false;
}

void Side::redo() {
    wanted_ = scene::readSettings(history_.redo().json());
    continues_ = follows_ = false;
}

void Side::follow() {
    if (follows_) return;
    follows_ = true;
    const hair::Settings before = player_.settings();
    try {
        if (continues_)
            player_.preview(wanted_);
        else
            player_.apply(wanted_);
        problem_.clear();
    } catch (const engine::DeviceLost&) {
        throw;
    } catch (const engine::Error& error) {
        problem_ = error.what();
    }
    if (!sameButCamera(before, player_.settings())) timings_.clear();
}

void Side::play(std::uint32_t frames, engine::Timing timing) {
    if (frames == 0) return;
    for (std::uint32_t i = 0; i + 1 < frames; ++i) player_.skip();
    player_.next(timing);
    timings_.add(player_.record(), timing, player_.frame());
}

void Side::seek(std::uint32_t frame) { player_.seek(frame); }

void Side::rebuild() {
    player_.rebuild();
    timings_.clear();
}

// ---- Moment of a drag ---------------------------------------------------------------------------

Moment momentAfter(std::uint32_t frame, double frame_time, double time_step) {
    const double step = frame_time > 0.0 ? frame_time : time_step;
    // A frame's time is one product, whichever frame it is asked in: a key that was written for a
    // frame is at that frame's time, to the last bit.
    const auto after = [&](double frames) {
        if (frame_time > 0.0)
            return static_cast<float>((static_cast<double>(frame) + 1.0 + frames) * step);
        return static_cast<float>(frames * step);
    };
    const auto ascending = [](float before, float time) {
        return std::max(time, std::nextafter(before, std::numeric_limits<float>::max()));
    };
    Moment moment{.now = after(0.0)};
    moment.next = ascending(moment.now, after(1.0));
    moment.later = ascending(moment.next, after(1.0 + Pacer::kMostFrames));
    return moment;
}

Moment momentOf(const Player& player) {
    const hair::Settings& settings = player.settings();
    return momentAfter(
        player.frame(), double{settings.run.frame_time}, double{settings.simulation.time_step});
}

// ---- Running clock ------------------------------------------------------------------------------

bool RunningClock::runs(const Player& player, double seconds) {
    const auto [entry, is_new] = seen_.try_emplace(&player, Seen{.frame = player.frame()});
    Seen& seen = entry->second;
    if (seen.frame != player.frame()) seen = {player.frame(), seconds};
    return seconds - seen.since < kPause;
}

}  // namespace benchmarks::viewer
