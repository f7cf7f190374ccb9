#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "benchmarks/case.h"
#include "engine/frame_loop.h"

namespace benchmarks {

// Plays one case as the runner does, frame by frame, and lets its settings change on the way. What
// it shows is always the frame that the runner would have drawn with these settings from the first
// frame on: where a change bears on the simulation, it is played anew up to the frame that was
// reached. Only a preview is not that.
class Player {
public:
    // Draws frame 0. Throws as Case does.
    Player(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory);

    // Throws engine::Error for settings that can't be; what was there is then kept.
    void apply(const hair::Settings& settings);

    // While something is being dragged: what can change without delay does, and the simulation goes
    // on from the present state where that is wind, colliders, motion or pulls; the rest waits for
    // apply(). Throws as apply().
    void preview(const hair::Settings& settings);
    // Whether what is shown is no frame of any settings: apply() plays it anew.
    bool previews() const { return previews_; }

    // Everything anew, for shaders that changed, up to the frame that was reached. Throws as Case;
    // what was there is then kept.
    void rebuild();

    // Plays and draws the next frame. `timing` is isolated or overlapped.
    void next(engine::Timing timing = engine::Timing::isolated);
    void skip();  // plays the next frame and does not draw it
    void redraw();  // draws the frame again
    void seek(std::uint32_t frame);  // plays from the first frame on

    std::uint32_t frame() const { return frame_; }
    // Simulated s at the end of the frame.
    double time() const;
    // As they are played.
    const hair::Settings& settings() const { return settings_; }
    const std::filesystem::path& directory() const { return directory_; }
    const Case& played() const { return *case_; }
    Case& played() { return *case_; }
    // What the last drawn frame took.
    const engine::FrameRecord& record() const { return record_; }

private:
    void play(engine::Timing timing, const std::function<void(engine::Passes&)>& record);
    void drawWith(const hair::Settings& settings);
    void replace(std::unique_ptr<Case> other, const hair::Settings& settings);

    const engine::Device& device_;
    std::filesystem::path directory_;
    hair::Settings settings_;
    std::unique_ptr<Case> case_;
    engine::FrameLoop isolated_;
    engine::FrameLoop overlapped_;
    engine::FrameRecord record_;
    std::uint32_t frame_ = 0;
    bool previews_ = false;
};

}  // namespace benchmarks
