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
#include "benchmarks/viewer/studio.h"

// The scene that is open, on one side or two, and the widgets of its time.
namespace benchmarks::viewer {

// Whether the camera of one side is the other's too.
enum class Cameras { linked, separate };

// The scene that is open: a side that is played, or two that are compared, and how time goes by for
// them. It says what is to be played and takes what came of it; whoever plays may take their time.
class OpenScene {
public:
    // `settings` may differ from the file's.
    OpenScene(const SceneFile& file, const hair::Settings& settings);

    const SceneFile& file() const { return file_; }

    // Another scene is to be opened in place of this one, on one side. It is once its first
    // picture is there; this scene is kept until then, and where that fails.
    void open(const SceneFile& file);

    std::size_t sideCount() const { return b_ ? 2 : 1; }
    Side& side(std::size_t index) { return index == 1 && b_ ? *b_ : *a_; }
    const Side& side(std::size_t index) const { return index == 1 && b_ ? *b_ : *a_; }
    // Null where there is none of that number.
    Side* find(std::uint64_t id);
    std::vector<Side*> sides();

    // A second side is to be added, with the settings and at the frame of the first. It is once its
    // first picture is there.
    void startComparing();
    void stopComparing();
    void swapSides();

    // The side that panels and keys change.
    std::size_t edited() const { return edited_; }
    void setEdited(std::size_t index) { edited_ = index < sideCount() ? index : 0; }
    Side& editedSide() { return side(edited_); }
    const Side& editedSide() const { return side(edited_); }
    // What the edited side's settings are compared with: the file's, or for the second side those
    // of the first.
    const hair::Settings& reference() const;

    Cameras cameras = Cameras::linked;
    // Side::edit() of a side; where cameras are linked, the other side's camera follows.
    void edit(std::size_t index, const hair::Settings& settings, Edit edit);

    // What is to be played now, `seconds` after the last order: the sides' settings, the frame that
    // was asked for and the frames that are due; at most one where every frame is wanted. A step
    // and a seek are taken from `state`.
    enum class Frames { as_due, every_one };
    Order order(PlayState& state, double seconds, Frames frames);
    // Whether something is to be made that has no picture yet: it is what order() asks for.
    bool isMaking() const { return coming_ || !a_->shown().isThere(); }
    // Whether an order with no frame to be played would change nothing.
    bool isFollowed() const;
    // Whether a side is being dragged.
    bool isDragged() const;

    // What came of an order.
    struct News {
        bool opened = false;  // another scene
        bool compares = false;  // since now
        std::exception_ptr failure;  // why a scene or a second side isn't there; or null
    };
    News take(std::vector<SideReply> replies, Side::Beside beside);

    // The scene was written to this file, with these settings.
    void savedAs(const std::filesystem::path& path, const hair::Settings& settings);
    bool wasSaved() const { return was_saved_; }

private:
    // A side that is being made: that of another scene, or the second one of this.
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
    engine::Timing timing_ = engine::Timing::isolated;  // how the last frame was timed
    Pacer pacer_;
};

// Pause, single step, restart, speed, seek and the timeline, in one line within the current window
// of Dear ImGui.
void playPanel(PlayState& state, const Shown& shown);

}  // namespace benchmarks::viewer
