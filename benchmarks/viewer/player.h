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
#include "benchmarks/viewer/picking.h"
#include "benchmarks/viewer/preview.h"
#include "benchmarks/viewer/shader_reload.h"
#include "benchmarks/viewer/timings.h"
#include "engine/frame_loop.h"

// What is played: frames by the window's clock, a case that follows its settings, and a side that
// has the settings, their history and what is shown of them.
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
    // The frame that is played to in parts, each of which is shown: another may be wanted
    // meanwhile.
    std::optional<std::uint32_t> scrub;
    std::uint32_t furthest = 0;  // frame that was shown
    // Simulated seconds per second; absent: one frame for every picture of the window.
    std::optional<double> speed;
};

// What a side shows: values alone, to be looked at by one thread while another plays on.
struct Shown {
    hair::Settings settings;  // that were played
    std::filesystem::path directory;  // what file names in them are relative to
    std::uint32_t frame = 0;
    bool previews = false;  // Player::previews()
    unsigned level = 0;  // of preview.h; at 0 the picture is the runner's
    double strand_share = 1.0;  // strands of the picture among those that the runner draws
    std::uint32_t width = 0;  // of the picture, px
    std::uint32_t height = 0;
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first
    std::uint64_t number = 0;  // no other picture of the window's has it
    bool has_guides = false;  // not where there are very many and frames are being played
    std::vector<glm::vec3> guides;  // [guide][vertex], m
    std::vector<glm::vec3> rest_guides;  // as `guides`, at rest, before the head moved
    std::uint32_t vertices_per_guide = 0;
    Sphere rest;  // round the guides at rest, before the head moved
    hair::simulation::RigidMotion head;
    std::vector<std::pair<std::string, std::uint64_t>> counts;  // Case::counts()
    report::BackendRecord backend;  // what draws the strands of whole pictures, and why
    report::CaseResult transparency;  // measure::addTransparency()

    bool isThere() const { return !picture.empty(); }
    // Whether it is the picture that the runner draws with these settings.
    bool isExact() const { return level == 0 && !previews; }
    // Simulated s at the end of the frame.
    double time() const;
    // As Case's of the picture and of the guides.
    std::string pictureHash() const;
    std::string stateHash() const;
};

// A sphere round the guides as they are or, where their places are not known, as they were at rest.
Sphere groomNow(const Shown& shown);

// Plays one case as the runner does, frame by frame, and lets its settings change on the way. What
// it shows is always the frame that the runner would have drawn with these settings from the first
// frame on: where a change bears on the simulation, it is played anew up to the frame that was
// reached. Only a preview shows something else.
class Player {
public:
    // Draws frame 0, at this level of preview.h. Throws as Case does. The cache may be null.
    Player(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory, measure::HairCache* cache = nullptr,
        unsigned level = 0);

    // Plays with these settings; refresh() draws them. Throws engine::Error for impossible ones,
    // and keeps the last.
    void apply(const hair::Settings& settings);

    // While something is being dragged: what can change without delay does, and the simulation goes
    // on from the present state where that is wind, colliders, motion or pulls; the rest waits for
    // apply(). Throws as apply().
    void preview(const hair::Settings& settings);
    // Whether what is shown is no frame of any settings: apply() plays it anew.
    bool previews() const { return previews_; }

    // The level of preview.h that pictures are drawn at from now on.
    void setLevel(unsigned level) { level_ = level; }

    // Makes everything anew, for shaders that changed, up to the frame that was reached. Throws as
    // Case, and keeps what was there.
    void rebuild();
    // The same where one of the scene's own files of GLSL was saved since it was read; false where
    // none was. Looks at them a few times a second.
    bool reread();

    // Plays and draws the next frame. `timing` is isolated or overlapped.
    void next(engine::Timing timing = engine::Timing::isolated);
    void skip();  // plays the next frame and does not draw it
    // Plays from the first frame on. Where it is asked to stop it throws engine::Interrupted, at a
    // frame before.
    void seek(std::uint32_t frame, const std::function<bool()>& stop = {});
    // Draws the frame again where settings or level are others than those it was drawn with.
    void refresh();

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
    // How many pictures were drawn.
    std::uint64_t pictures() const { return pictures_; }
    // The last picture, and what there is to know of its frame. With Guides::few no more than
    // a picture's worth of them.
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
    // Of levels from 1 on; made when they are first drawn with these settings.
    std::array<std::unique_ptr<hair::rendering::Renderer>, kPreviewLevels.size()> coarse_;
    engine::FrameLoop isolated_;
    engine::FrameLoop overlapped_;
    engine::FrameRecord record_;
    std::uint32_t frame_ = 0;
    bool previews_ = false;
    unsigned level_ = 0;
    unsigned drawn_level_ = 0;
    bool outdated_ = false;  // the settings are no longer those of the picture
    std::uint64_t pictures_ = 0;
    WatchedFiles files_;
    std::chrono::steady_clock::time_point next_look_;
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

// What is asked of the hair of a side, and what comes back.

// The settings that a side is to be played with.
struct SideOrder {
    std::uint64_t side = 0;  // Side::id()
    std::uint64_t revision = 0;  // changes with the settings
    hair::Settings settings;
    bool continues = false;  // they are being dragged
    std::filesystem::path directory;
    // The side at whose frame one begins that was not played before; absent: at frame 0.
    std::optional<std::uint64_t> beside;
};

// A frame that was timed while nothing else was asked of the machine.
struct TimedFrame {
    engine::FrameRecord record;
    engine::Timing timing = engine::Timing::isolated;
    std::uint32_t number = 0;
};

struct SideReply {
    std::uint64_t side = 0;
    std::uint64_t revision = 0;  // of the settings that were followed, or refused
    std::string problem;  // why they were refused; empty: they were not
    std::exception_ptr failure;  // why a side that was not played before is not there; or null
    bool reread = false;  // files that the settings name have other texts now
    bool restarts_timings = false;  // frames before are of other settings
    std::optional<TimedFrame> timed;
    std::optional<Shown> shown;  // where another picture was drawn
};

// Settings that widgets change, what they were, and what is seen of the hair that follows them. A
// viewer that compares has two.
class Side {
public:
    // `id` is no other side's. `directory` is what file names in the settings are relative to.
    Side(std::uint64_t id, const hair::Settings& settings, const std::filesystem::path& directory);

    std::uint64_t id() const { return id_; }
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

    SideOrder order() const;
    // Timings of a frame that something else was done beside are left out.
    enum class Beside { nothing, other_work };
    void take(SideReply reply, Beside beside);
    // What was asked for last.
    std::uint64_t revision() const { return revision_; }
    std::uint64_t answered() const { return answered_; }  // what was followed or refused last
    // Whether what was asked for last was followed or refused.
    bool isFollowed() const { return answered_ == revision_; }
    // Whether an edit is going on.
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

// The simulated times, s, strictly ascending, that a drag writes keys at. A drag changes nothing
// that was played already: what is dragged is where the mouse has it from the next frame on.
struct Moment {
    float now = 0.0f;
    float next = 0.0f;  // end of the next frame
    float later = 0.0f;  // after all frames that may be played before the mouse is asked again
};

// `frame` was played last. Where frames advance by 0 s, the next one counts as a `time_step`.
Moment momentAfter(std::uint32_t frame, double frame_time, double time_step);

Moment momentOf(const Shown& shown);

// Whether frames are being played, by their numbers: a device that is too slow counts as paused.
class RunningClock {
public:
    // `seconds` of the window's clock. What is shown of a side keeps its place.
    bool runs(const Shown& shown, double seconds);

private:
    struct Seen {
        std::uint32_t frame = 0;
        double since = -1e9;  // when another frame came
    };
    std::map<const Shown*, Seen> seen_;
};

}  // namespace benchmarks::viewer
