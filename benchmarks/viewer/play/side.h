#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/play/player.h"
#include "benchmarks/viewer/settings/edit_history.h"
#include "benchmarks/viewer/timings/timing_history.h"

namespace benchmarks {

// Settings that widgets change, what they were, and the hair that follows them. A viewer that
// compares has two.
class Side {
public:
    // `directory` is what file names in the settings are relative to. Draws frame 0. Throws as
    // Case.
    Side(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory);

    // As widgets have them. They may be impossible: then problem() says why, and others are played.
    const hair::Settings& wanted() const { return wanted_; }
    // As they are on disk.
    const hair::Settings& original() const { return original_; }
    const std::string& problem() const { return problem_; }

    // An edit that continues is one with those before it for undo(), until settle().
    void edit(const hair::Settings& settings, Edit edit);
    // Nothing is being dragged any more.
    void settle();
    void undo();
    void redo();
    bool canUndo() const { return history_.canUndo(); }
    bool canRedo() const { return history_.canRedo(); }
    void setOriginal(const hair::Settings& settings) { original_ = settings; }

    // Makes the player follow wanted(). What the device refuses becomes problem().
    void follow();
    // Plays frames, the last of which is drawn and measured.
    void play(std::uint32_t frames, engine::Timing timing);
    void seek(std::uint32_t frame);
    // Everything anew, for shaders that changed. Throws as Case; what was there is then kept.
    void rebuild();

    const Player& player() const { return player_; }
    Player& player() { return player_; }
    const TimingHistory& timings() const { return timings_; }
    TimingHistory& timings() { return timings_; }

private:
    hair::Settings wanted_;
    hair::Settings original_;
    std::string problem_;
    EditHistory history_;
    bool continues_ = false;
    bool follows_ = true;  // the player has wanted_, or has refused it
    Player player_;
    TimingHistory timings_;
};

}  // namespace benchmarks
