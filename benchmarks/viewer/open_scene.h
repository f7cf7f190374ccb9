#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/scene_file.h"

// The scene that is open, on one side or two, and the widgets of its time.
namespace benchmarks::viewer {

// Whether the camera of one side is the other's too.
enum class Cameras { linked, separate };

// The scene that is open: a side that plays it, or two that are compared, and how time goes by for
// them.
class OpenScene {
public:
    // `settings` may differ from the file's. Throws as Side.
    OpenScene(const engine::Device& device, const SceneFile& file, const hair::Settings& settings);

    const SceneFile& file() const { return file_; }

    // Opens another scene in place of this one, on one side. Throws as Side; this scene is then
    // kept.
    void open(const SceneFile& file);

    std::size_t sideCount() const { return b_ ? 2 : 1; }
    Side& side(std::size_t index) { return index == 1 && b_ ? *b_ : *a_; }
    const Side& side(std::size_t index) const { return index == 1 && b_ ? *b_ : *a_; }
    std::vector<Side*> sides();

    // Adds a second side, with the settings and at the frame of the first. Throws as Side.
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

    // Lets the sides follow their settings, and plays the frames that are due for a picture of the
    // window after `seconds`; at most one where every frame is wanted. True where any was played.
    enum class Frames { as_due, every_one };
    bool play(PlayState& state, double seconds, Frames frames);

    // The scene was written to this file.
    void savedAs(const std::filesystem::path& path);
    bool wasSaved() const { return was_saved_; }

private:
    const engine::Device& device_;
    SceneFile file_;
    std::unique_ptr<Side> a_;
    std::unique_ptr<Side> b_;
    std::size_t edited_ = 0;
    bool was_saved_ = false;
    engine::Timing timing_ = engine::Timing::isolated;  // how the last frame was timed
    Pacer pacer_;
};

// Pause, single step, restart, speed and seek, in one line within the current window of Dear ImGui.
// `time`: simulated s.
void playPanel(PlayState& state, std::uint32_t frame, double time);

}  // namespace benchmarks::viewer
