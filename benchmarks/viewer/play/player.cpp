#include "benchmarks/viewer/play/player.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/check_settings.h"
#include "benchmarks/write_settings.h"

namespace benchmarks {

namespace {

// What a change means for what is there.
enum class Effect {
    none,
    camera,
    drawing,
    forces,  // what the simulation can take on the way
    everything,
};

Effect effectOf(const hair::Settings& before, const hair::Settings& after) {
    Json a = writeSettings(before), b = writeSettings(after);
    const auto without = [&](const char* member) {
        a.erase(member);
        b.erase(member);
        return a == b;
    };
    if (without("description")) return Effect::none;
    for (const char* member : {"groom", "seed", "run"})
        if (a[member] != b[member]) return Effect::everything;
    if (a["simulation"] != b["simulation"]) {
        for (Json* document : {&a, &b})
            for (const char* member : {"wind", "colliders", "motion", "pulls"})
                (*document)["simulation"].erase(member);
        return a["simulation"] == b["simulation"] ? Effect::forces : Effect::everything;
    }
    return without("camera") ? Effect::camera : Effect::drawing;
}

}  // namespace

Player::Player(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory)
    : device_(device), directory_(directory), settings_(settings),
      case_(std::make_unique<Case>(device, settings, directory)),
      isolated_(device, engine::Timing::isolated), overlapped_(device, engine::Timing::overlapped) {
    seek(0);
}

double Player::time() const {
    return (static_cast<double>(frame_) + 1.0) * double{settings_.run.frame_time};
}

void Player::apply(const hair::Settings& settings) {
    const Effect effect = effectOf(settings_, settings);
    if (effect == Effect::none && !previews_) return;
    checkSettings(settings);
    if (effect == Effect::forces || effect == Effect::everything || previews_) {
        replace(std::make_unique<Case>(device_, settings, directory_), settings);
        return;
    }
    drawWith(settings);
}

void Player::preview(const hair::Settings& settings) {
    const Effect effect = effectOf(settings_, settings);
    if (effect == Effect::none || effect == Effect::everything) return;
    checkSettings(settings);
    if (effect == Effect::forces) {
        case_->carryOn(settings.simulation);
        settings_.simulation = settings.simulation;
        previews_ = true;
        return;
    }
    drawWith(settings);
}

// Draws the same frame otherwise.
void Player::drawWith(const hair::Settings& settings) {
    if (effectOf(settings_, settings) == Effect::camera)
        case_->setCamera(settings.camera);
    else
        case_->setDrawing(settings);
    settings_ = settings;
    redraw();
}

void Player::rebuild() {
    replace(std::make_unique<Case>(device_, settings_, directory_), settings_);
}

void Player::replace(std::unique_ptr<Case> other, const hair::Settings& settings) {
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
        case_ = std::make_unique<Case>(device_, settings_, directory_);
    else
        case_->reset();
    frame_ = 0;
    while (frame_ < frame) skip();
    play(engine::Timing::isolated, [&](engine::Passes& passes) { case_->frame(passes); });
}

}  // namespace benchmarks
