#include "benchmarks/viewer/play/side.h"

#include <nlohmann/json.hpp>

#include "benchmarks/read_settings.h"
#include "benchmarks/write_settings.h"
#include "engine/device_lost.h"

namespace benchmarks {

namespace {

Document documentOf(const hair::Settings& settings) { return Document(writeSettings(settings)); }

bool sameButCamera(hair::Settings a, const hair::Settings& b) {
    a.camera = b.camera;
    return documentOf(a) == documentOf(b);
}

}  // namespace

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
    wanted_ = readSettings(history_.undo().json());
    continues_ = follows_ = false;
}

void Side::redo() {
    wanted_ = readSettings(history_.redo().json());
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

}  // namespace benchmarks
