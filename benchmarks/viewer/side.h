#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/timings.h"
#include "engine/frame_loop.h"
#include "hair/settings.h"

// A side of the window: settings that widgets change, their history, the orders for the player that
// follows them, and what is shown of it.
namespace benchmarks::viewer {

// Past settings of a scene, for undo and redo.
class EditHistory {
public:
    explicit EditHistory(const hair::Settings& settings);

    const hair::Settings& current() const { return states_[index_]; }

    // Adds a state and discards undone ones. With `continues`, as in a drag of a slider, it
    // replaces the last state.
    void edit(const hair::Settings& settings, bool continues);
    // Ends a drag: the next state is a new one.
    void settle() { continuing_ = false; }

    bool canUndo() const { return index_ > 0; }
    bool canRedo() const { return index_ + 1 < states_.size(); }
    const hair::Settings& undo();
    const hair::Settings& redo();

private:
    std::vector<hair::Settings> states_;
    std::size_t index_ = 0;
    bool continuing_ = false;
};

// The settings to play a side with.
struct SideOrder {
    std::uint64_t side = 0;  // Side::id()
    std::uint64_t revision = 0;  // changes with the settings
    hair::Settings settings;
    bool continues = false;  // a drag is in progress
    std::filesystem::path directory;
    // A new side starts at the frame of this side; absent: at frame 0.
    std::optional<std::uint64_t> beside;
};

// A frame that was timed while this program gave the machine no other work.
struct TimedFrame {
    engine::FrameRecord record;
    engine::Timing timing = engine::Timing::isolated;
    std::uint32_t number = 0;
};

struct SideReply {
    std::uint64_t side = 0;
    std::uint64_t revision = 0;  // of the applied or refused settings
    std::string problem;  // why they were refused; empty: they were applied
    std::exception_ptr failure;  // why a new side could not be made; or null
    bool reread = false;  // GLSL files of the settings have changed
    bool restarts_timings = false;  // earlier timings belong to other settings
    std::optional<TimedFrame> timed;
    std::optional<Shown> shown;  // present if another picture was drawn
};

// Settings that widgets change, with their history, and what is shown of the hair that follows
// them. A viewer that compares has two.
class Side {
public:
    // `id` is unique among sides. File names in the settings are relative to `directory`.
    Side(std::uint64_t id, const hair::Settings& settings, const std::filesystem::path& directory);

    std::uint64_t id() const { return id_; }
    // Returns the settings in the widgets. If they are impossible, problem() gives the reason and
    // other settings are played.
    const hair::Settings& wanted() const { return wanted_; }
    // Returns the settings on disk.
    const hair::Settings& original() const { return original_; }
    const std::string& problem() const { return problem_; }

    // Continued edits count as one for undo(), until settle().
    void edit(const hair::Settings& settings, Edit edit);
    // Ends a drag.
    void settle();
    void undo();
    void redo();
    bool canUndo() const { return history_.canUndo(); }
    bool canRedo() const { return history_.canRedo(); }
    void setOriginal(const hair::Settings& settings) { original_ = settings; }

    SideOrder order() const;
    // Drops timings of a frame that ran beside other work.
    enum class Beside { nothing, other_work };
    void take(SideReply reply, Beside beside);
    // Returns the revision of the last request.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t answered() const { return answered_; }  // the last applied or refused revision
    // Whether the last request was applied or refused.
    bool isFollowed() const { return answered_ == revision_; }
    // Whether an edit is in progress.
    bool isDragged() const { return continues_; }

    const Shown& shown() const { return shown_; }
    const TimingHistory& timings() const { return timings_; }
    TimingHistory& timings() { return timings_; }

private:
    std::uint64_t id_;
    std::filesystem::path directory_;
    hair::Settings wanted_;
    hair::Settings original_;
    std::string problem_;
    EditHistory history_;
    bool continues_ = false;
    std::uint64_t revision_ = 1;
    std::uint64_t answered_ = 0;
    Shown shown_;
    TimingHistory timings_;
};

}  // namespace benchmarks::viewer
