#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/scene_file.h"
#include "benchmarks/viewer/side.h"
#include "benchmarks/viewer/studio.h"
#include "hair/settings.h"

// The open scene, and its timeline.

namespace benchmarks::viewer {

// The timeline: a bar of the scene's frames with marks of events, and a scrubber.

// An event of a scene.
struct TimelineMark {
    enum class Kind { keyframe, pull };
    Kind kind = Kind::keyframe;
    float from = 0.0f;  // in frames: 0 is the end of frame 0; -1 is the start
    float to = 0.0f;  // end of a pull; equal to `from` for a keyframe
};

// Returns the keyframes of the head's motion and the pulls of hands, in their order; none if frames
// advance by no time.
std::vector<TimelineMark> timelineMarks(const hair::Settings& settings);

// Returns the last frame of the bar: it covers the shown frame, all frames shown before, all marks
// and at least two seconds.
std::uint32_t
timelineEnd(const hair::Settings& settings, std::uint32_t frame, std::uint32_t furthest);

// The user's wishes about time. Simulated time always advances in the scene's fixed steps; the
// speed only decides when a frame is played.
struct PlayState {
    bool playing = true;
    bool step = false;  // plays one frame while paused
    std::optional<std::uint32_t> seek;
    // A frame to play to in parts, each of which is shown, because the user may choose another one
    // meanwhile.
    std::optional<std::uint32_t> scrub;
    std::uint32_t furthest = 0;  // last frame that was shown so far
    // Simulated seconds per second; absent: one frame per picture of the window.
    std::optional<double> speed;
};

// Shows the bar across the rest of the current window, or nothing if that is narrow. Dragging it
// pauses and sets PlayState::scrub.
void timeline(PlayState& state, const Shown& shown);

// Whether both sides share one camera.
enum class Cameras { linked, separate };

// The open scene: one side that is played, or two that are compared, and how their time advances.
// Gives orders to play and takes the results, which may arrive later.
class OpenScene {
public:
    // `settings` may differ from the file's settings.
    OpenScene(const SceneFile& file, const hair::Settings& settings);

    const SceneFile& file() const { return file_; }

    // Starts to open another scene on one side. It replaces this one when its first picture exists.
    // This scene stays until then, or if opening fails.
    void open(const SceneFile& file);

    std::size_t sideCount() const { return b_ ? 2 : 1; }
    Side& side(std::size_t index) { return index == 1 && b_ ? *b_ : *a_; }
    const Side& side(std::size_t index) const { return index == 1 && b_ ? *b_ : *a_; }
    // Returns null for an unknown id.
    Side* find(std::uint64_t id);
    std::vector<Side*> sides();

    // Starts to add a second side, with the settings and frame of the first. It appears when its
    // first picture exists.
    void startComparing();
    void stopComparing();
    void swapSides();

    // The side that panels and keys edit.
    std::size_t edited() const { return edited_; }
    void setEdited(std::size_t index) { edited_ = index < sideCount() ? index : 0; }
    Side& editedSide() { return side(edited_); }
    const Side& editedSide() const { return side(edited_); }
    // Returns the settings that the edited side is compared with: the file's, or for the second
    // side those of the first.
    const hair::Settings& reference() const;

    Cameras cameras = Cameras::linked;
    // Edits a side with Side::edit(). With linked cameras, the other side's camera follows.
    void edit(std::size_t index, const hair::Settings& settings, Edit edit);

    // Returns what to play now, `seconds` after the last order: the sides' settings, a requested
    // frame, and the frames that are due, or at most one with `every_one`. Consumes a step or seek
    // from `state`.
    enum class Frames { as_due, every_one };
    Order order(PlayState& state, double seconds, Frames frames);
    // Whether a side is being made that has no picture yet. order() then asks for it.
    bool isMaking() const { return coming_ || !a_->shown().isThere(); }
    // Whether an order without frames to play would change nothing.
    bool isFollowed() const;
    // Whether an edit on a side is in progress.
    bool isDragged() const;

    // News from the replies to an order.
    struct News {
        bool opened = false;  // another scene was opened
        bool compares = false;  // comparing has started
        std::exception_ptr failure;  // why a scene or a second side could not be made; or null
    };
    News take(std::vector<SideReply> replies, Side::Beside beside);

    // Notes that the scene was written to this file with these settings.
    void savedAs(const std::filesystem::path& path, const hair::Settings& settings);
    bool wasSaved() const { return was_saved_; }

private:
    // A side that is being made: for another scene, or the second one of this scene.
    struct Coming {
        std::unique_ptr<Side> side;
        std::optional<SceneFile> file;  // of the other scene
    };
    std::unique_ptr<Side>
    makeSide(const hair::Settings& settings, const std::filesystem::path& directory);
    void arrive(News& news);

    std::uint64_t sides_made_ = 0;
    SceneFile file_;
    std::unique_ptr<Side> a_;
    std::unique_ptr<Side> b_;
    std::optional<Coming> coming_;
    std::size_t edited_ = 0;
    bool was_saved_ = false;
    engine::Timing timing_ = engine::Timing::isolated;  // mode of the last frame
    Pacer pacer_;
};

// Pause, single step, restart, speed, seek and the timeline, on one line within the current Dear
// ImGui window.
void playPanel(PlayState& state, const Shown& shown);

}  // namespace benchmarks::viewer
