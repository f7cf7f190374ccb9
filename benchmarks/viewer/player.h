#pragma once

#include <cstddef>
#include <array>
#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/edit.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/preview.h"
#include "benchmarks/viewer/shader_reload.h"
#include "engine/frame_loop.h"

// Plays frames by the window's clock. Also has a case that follows its settings, and a side with
// its settings, their history and what is shown of them.
namespace benchmarks::viewer {

// Decides how many frames to play per picture of the window.
class Pacer {
public:
    static constexpr std::uint32_t kMostFrames = 16;  // of pictures: a slow device falls behind the
                                                      // clock

    // `seconds` since the last picture; `frame_time` in simulated s per frame; `speed` in simulated
    // seconds per second, absent: always one frame. Returns 0 for a time or speed of 0.
    std::uint32_t framesFor(double seconds, double frame_time, std::optional<double> speed);

private:
    double due_ = 0.0;  // frames, below 1
};

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

// Values of what a side shows, for one thread to read while another plays on.
struct Shown {
    hair::Settings settings;  // the played settings
    std::filesystem::path directory;  // file names in the settings are relative to this
    std::uint32_t frame = 0;
    bool previews = false;  // Player::previews()
    unsigned level = 0;  // preview level (preview.h); 0: the runner's picture
    double strand_share = 1.0;  // strands in the picture over the runner's
    std::uint32_t width = 0;  // of the picture, px
    std::uint32_t height = 0;
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first
    std::uint64_t number = 0;  // unique among the window's pictures
    bool has_guides = false;  // false with very many guides while frames are played
    std::vector<glm::vec3> guides;  // [guide][vertex], m
    std::vector<glm::vec3> rest_guides;  // like `guides`, at rest, before head motion
    std::uint32_t vertices_per_guide = 0;
    Sphere rest;  // around the guides at rest, before head motion
    hair::simulation::RigidMotion head;
    std::vector<std::pair<std::string, std::uint64_t>> counts;  // Case::counts()
    report::BackendRecord backend;  // back end for whole pictures, and why
    report::CaseResult transparency;  // measure::addTransparency()

    bool isThere() const { return !picture.empty(); }
    // Whether this is the runner's picture with these settings.
    bool isExact() const { return level == 0 && !previews; }
    // Returns the simulated s at the end of the frame.
    double time() const;
    // Hashes of the picture and of the guides, like Case's.
    std::string pictureHash() const;
    std::string stateHash() const;
};

// Returns a sphere around the guides now, or at rest if their positions are unknown.
Sphere groomNow(const Shown& shown);

// Plays one case frame by frame like the runner, while its settings may change. It always shows the
// frame that the runner would have drawn with these settings from the first frame on. If a change
// affects the simulation, it is replayed up to the current frame. Only a preview differs.
class Player {
public:
    // Draws frame 0 at this level of preview.h. Throws like Case. The cache may be null.
    Player(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory, measure::HairCache* cache = nullptr,
        unsigned level = 0);

    // Plays with these settings; refresh() draws them. Throws engine::Error for impossible ones and
    // then keeps the previous ones.
    void apply(const hair::Settings& settings);

    // Applies settings during a drag. Anything that can change without delay does. For wind,
    // colliders, motion or pulls, the simulation continues from its present state. Everything else
    // waits for apply(). Throws like apply().
    void preview(const hair::Settings& settings);
    // Whether the shown frame belongs to no settings; apply() then replays it.
    bool previews() const { return previews_; }

    // Sets the level of preview.h for the next pictures.
    void setLevel(unsigned level) { level_ = level; }

    // Recreates everything after shaders have changed, up to the current frame. Throws like Case
    // and then keeps the previous state.
    void rebuild();
    // Recreates everything if one of the scene's GLSL files was saved since it was read; otherwise
    // returns false. Checks a few times per second.
    bool reread();

    // Plays and draws the next frame. `timing` is isolated or overlapped.
    void next(engine::Timing timing = engine::Timing::isolated);
    void skip();  // plays the next frame without drawing it
    // Plays from the first frame to `frame`. Throws engine::Interrupted at an earlier frame if
    // `stop` returns true.
    void seek(std::uint32_t frame, const std::function<bool()>& stop = {});
    // Draws the frame again if settings or level have changed since.
    void refresh();

    std::uint32_t frame() const { return frame_; }
    // Returns the simulated s at the end of the frame.
    double time() const;
    // The played settings.
    const hair::Settings& settings() const { return settings_; }
    const std::filesystem::path& directory() const { return directory_; }
    const measure::Case& played() const { return *case_; }
    measure::Case& played() { return *case_; }
    // Times of the last drawn frame.
    const engine::FrameRecord& record() const { return record_; }
    // Number of drawn pictures.
    std::uint64_t pictures() const { return pictures_; }
    // Returns the last picture and facts about its frame. Guides::few leaves out guides that would
    // take more bytes than a picture.
    enum class Guides { all, few };
    Shown shown(Guides guides = Guides::all) const;

private:
    void play(engine::Timing timing, const std::function<void(engine::Passes&)>& record);
    void drawWith(const hair::Settings& settings);
    void drawFrame(engine::Timing timing, const std::function<void(engine::Passes&)>& simulate);
    hair::rendering::Renderer& coarse();
    std::unique_ptr<measure::Case> caseOf(const hair::Settings& settings) const;
    void replace(std::unique_ptr<measure::Case> other, const hair::Settings& settings);

    void watch();

    const engine::Device& device_;
    std::filesystem::path directory_;
    measure::HairCache* cache_;
    hair::Settings settings_;
    std::unique_ptr<measure::Case> case_;
    // For levels from 1; created when first drawn with these settings.
    std::array<std::unique_ptr<hair::rendering::Renderer>, kPreviewLevels.size()> coarse_;
    engine::FrameLoop isolated_;
    engine::FrameLoop overlapped_;
    engine::FrameRecord record_;
    std::uint32_t frame_ = 0;
    bool previews_ = false;
    unsigned level_ = 0;
    unsigned drawn_level_ = 0;
    bool outdated_ = false;  // the picture was drawn with other settings
    std::uint64_t pictures_ = 0;
    WatchedFiles files_;
    std::chrono::steady_clock::time_point next_look_;
};

// Records of frames in one timing mode, oldest first.
struct TimedFrames {
    std::vector<engine::FrameRecord> records;
    std::vector<std::uint32_t> numbers;  // each frame's number in the simulation, from 0

    std::size_t size() const { return records.size(); }
};

// Records of the last drawn frames, by timing mode. The history must be cleared when settings
// change, so that frames of different settings do not mix.
class TimingHistory {
public:
    static constexpr std::size_t kFrames = 300;  // limit per mode

    // `timing` is isolated or overlapped.
    void add(const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number);
    void clear();

    const TimedFrames& isolated() const { return isolated_; }
    const TimedFrames& overlapped() const { return overlapped_; }

    // Changes with each clear(); earlier results then belong to other settings.
    std::uint64_t revision() const { return revision_; }

private:
    TimedFrames isolated_;
    TimedFrames overlapped_;
    std::uint64_t revision_ = 0;
};

// Past documents of a scene, for undo and redo.
class EditHistory {
public:
    explicit EditHistory(scene::Document document);

    const scene::Document& current() const { return documents_[index_]; }

    // Adds a state and discards undone ones. With `continues`, as in a drag of a slider, it
    // replaces the last state.
    void edit(scene::Document document, bool continues);
    // Ends a drag: the next state is a new one.
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

// Orders for a side, and their replies.

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

// Simulated times, s, strictly ascending, at which a drag writes keys. A drag does not change
// played frames; the dragged object follows the mouse from the next frame on.
struct Moment {
    float now = 0.0f;
    float next = 0.0f;  // end of the next frame
    float later = 0.0f;  // after all frames that may be played before the mouse is read again
};

// `frame` was the last played frame. If frames advance by 0 s, the next one counts as a
// `time_step`.
Moment momentAfter(std::uint32_t frame, double frame_time, double time_step);

Moment momentOf(const Shown& shown);

// Whether frames are being played, judged by their numbers: a device that is too slow counts as
// paused.
class RunningClock {
public:
    // `seconds` of the window's clock. The Shown of a side must keep its address.
    bool runs(const Shown& shown, double seconds);

private:
    struct Seen {
        std::uint32_t frame = 0;
        double since = -1e9;  // when the frame last changed
    };
    std::map<const Shown*, Seen> seen_;
};

}  // namespace benchmarks::viewer
