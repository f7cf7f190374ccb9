#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/timings.h"
#include "engine/frame_loop.h"

// What is played: frames by the window's clock, a case that follows its settings, and a side that
// has the settings, their history and the player.
namespace benchmarks::viewer {

// How many frames are to be played for a picture of the window.
class Pacer {
public:
    static constexpr std::uint32_t kMostFrames = 16;  // per picture: a slow device falls behind

    // `seconds` since the last picture; `frame_time` simulated s that a frame advances; `speed` in
    // simulated seconds per second, absent: always one frame. A time or speed of 0 gives no frame.
    std::uint32_t framesFor(double seconds, double frame_time, std::optional<double> speed);

private:
    double due_ = 0.0;  // frames, below 1
};

// What the user wants of time. Simulated time always advances in the scene's fixed steps; the speed
// decides only when a frame is played.
struct PlayState {
    bool playing = true;
    bool step = false;  // plays one frame while paused
    std::optional<std::uint32_t> seek;
    // Simulated seconds per second; absent: one frame for every picture of the window.
    std::optional<double> speed;
};

// Plays one case as the runner does, frame by frame, and lets its settings change on the way. What
// it shows is always the frame that the runner would have drawn with these settings from the first
// frame on: where a change bears on the simulation, it is played anew up to the frame that was
// reached. Only a preview shows something else.
class Player {
public:
    // Draws frame 0. Throws as Case does.
    Player(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory);

    // Plays with these settings. Throws engine::Error for impossible ones, and keeps the last.
    void apply(const hair::Settings& settings);

    // While something is being dragged: what can change without delay does, and the simulation goes
    // on from the present state where that is wind, colliders, motion or pulls; the rest waits for
    // apply(). Throws as apply().
    void preview(const hair::Settings& settings);
    // Whether what is shown is no frame of any settings: apply() plays it anew.
    bool previews() const { return previews_; }

    // Makes everything anew, for shaders that changed, up to the frame that was reached. Throws as
    // Case, and keeps what was there.
    void rebuild();

    // Plays and draws the next frame. `timing` is isolated or overlapped.
    void next(engine::Timing timing = engine::Timing::isolated);
    void skip();  // plays the next frame and does not draw it
    void seek(std::uint32_t frame);  // plays from the first frame on

    std::uint32_t frame() const { return frame_; }
    // Simulated s at the end of the frame.
    double time() const;
    // The settings that are played.
    const hair::Settings& settings() const { return settings_; }
    const std::filesystem::path& directory() const { return directory_; }
    const measure::Case& played() const { return *case_; }
    measure::Case& played() { return *case_; }
    // What the last drawn frame took.
    const engine::FrameRecord& record() const { return record_; }

private:
    void play(engine::Timing timing, const std::function<void(engine::Passes&)>& record);
    void drawWith(const hair::Settings& settings);
    void redraw();
    void replace(std::unique_ptr<measure::Case> other, const hair::Settings& settings);

    const engine::Device& device_;
    std::filesystem::path directory_;
    hair::Settings settings_;
    std::unique_ptr<measure::Case> case_;
    engine::FrameLoop isolated_;
    engine::FrameLoop overlapped_;
    engine::FrameRecord record_;
    std::uint32_t frame_ = 0;
    bool previews_ = false;
};

// The documents that a scene has been, for undo and redo.
class EditHistory {
public:
    explicit EditHistory(scene::Document document);

    const scene::Document& current() const { return documents_[index_]; }

    // Adds a state; what was undone is gone. A state that `continues` the last one, as while a
    // slider is dragged, replaces it.
    void edit(scene::Document document, bool continues);
    // The next state continues nothing: the slider was let go.
    void settle() { continuing_ = false; }

    bool canUndo() const { return index_ > 0; }
    bool canRedo() const { return index_ + 1 < documents_.size(); }
    const scene::Document& undo();
    const scene::Document& redo();

private:
    std::vector<scene::Document> documents_;
    std::size_t index_ = 0;
    bool continuing_ = false;
};

// Settings that widgets change, what they were, and the hair that follows them. A viewer that
// compares has two.
class Side {
public:
    // `directory` is what file names in the settings are relative to. Draws frame 0. Throws as
    // Case.
    Side(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory);

    // The settings that widgets have. They may be impossible: then problem() says why, and others
    // are played.
    const hair::Settings& wanted() const { return wanted_; }
    // The settings on disk.
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
    // Player::rebuild(), with no timings of the old shaders.
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

// The simulated times, s, strictly ascending, that a drag writes keys at. A drag changes nothing
// that was played already: what is dragged is where the mouse has it from the next frame on.
struct Moment {
    float now = 0.0f;
    float next = 0.0f;  // end of the next frame
    float later = 0.0f;  // after all frames that may be played before the mouse is asked again
};

// `frame` was played last. Where frames advance by 0 s, the next one counts as a `time_step`.
Moment momentAfter(std::uint32_t frame, double frame_time, double time_step);

Moment momentOf(const Player& player);

// Whether frames are being played, by their numbers: a device that is too slow counts as paused.
class RunningClock {
public:
    // `seconds` of the window's clock.
    bool runs(const Player& player, double seconds);

private:
    struct Seen {
        std::uint32_t frame = 0;
        double since = -1e9;  // when another frame came
    };
    std::map<const Player*, Seen> seen_;
};

}  // namespace benchmarks::viewer
