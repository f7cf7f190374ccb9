#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/report/report.h"
#include "benchmarks/viewer/gizmo.h"
#include "benchmarks/viewer/shader_reload.h"
#include "engine/frame_loop.h"
#include "hair/simulation/probes.h"

// Plays frames by the window's clock: a case that follows its settings, what is shown of it, and
// coarser pictures during motion, if whole pictures take too long.
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

// ---- Levels of preview --------------------------------------------------------------------------

// Levels of a picture: the scene's own and the previews, each with about half the work of the one
// before. Previews have fewer strands and segments (/lod) and fewer pixels, since strands grow
// wider as they become fewer. Previews have one sample per pixel.
struct PreviewLevel {
    float coarser = 0.0f;  // added to the level of detail
    float across = 1.0f;  // share of the pixels along either side of the picture
};
inline constexpr std::array kPreviewLevels{
    PreviewLevel{},
    PreviewLevel{1.0f, 0.75f},
    PreviewLevel{2.0f, 0.5f},
    PreviewLevel{3.0f, 0.375f},
    PreviewLevel{4.0f, 0.25f},
    PreviewLevel{5.0f, 0.25f},
    PreviewLevel{6.0f, 0.25f},
    PreviewLevel{7.0f, 0.25f}};
inline constexpr unsigned kCoarsestPreview = kPreviewLevels.size() - 1;

// Returns the settings for a level. Those of level 0 are unchanged; others differ only in /lod and
// /render. Levels of detail by distance become the level at the camera's target.
hair::Settings previewSettings(const hair::Settings& settings, unsigned level);

// "preview, level 3 of 7: 12 % of strands at 480 × 270"
std::string
previewText(unsigned level, double strand_share, std::uint32_t width, std::uint32_t height);

// ---- Player -------------------------------------------------------------------------------------

// Values of what a side shows, for one thread to read while another plays on.
struct Shown {
    hair::Settings settings;  // the played settings
    std::filesystem::path directory;  // file names in the settings are relative to this
    std::uint32_t frame = 0;
    bool previews = false;  // Player::previews()
    unsigned level = 0;  // preview level; 0: the runner's picture
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
    measure::PlayedProbes probes;  // of the last Player::kMostProbed frames; without pass times

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
    static constexpr std::size_t kMostProbed = 3600;  // a minute at 1/60 s

    // Draws frame 0 at this level of preview. Throws like Case. The cache may be null.
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

    // Sets the level of preview for the next pictures.
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
    std::unique_ptr<hair::simulation::Probes>
    probesOf(const measure::Case& probed, const hair::Settings& settings) const;
    void probe();

    void watch();

    const engine::Device& device_;
    std::filesystem::path directory_;
    measure::HairCache* cache_;
    hair::Settings settings_;
    std::unique_ptr<measure::Case> case_;
    std::unique_ptr<hair::simulation::Probes> probes_;  // of one frame; null: none are wanted
    measure::PlayedProbes probed_;
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

// ---- Choice of the level of preview -------------------------------------------------------------

// Chooses levels by the time that pictures took. Uses no clock, so it depends on its inputs alone.
class PreviewControl {
public:
    static constexpr double kAim = 100.0;  // ms, maximum for a picture in motion

    static constexpr double kCrawl = 1000.0;  // ms

    // The level of a scene's first picture, whose time is not known: it appears soon, and on a fast
    // device a finer one soon after.
    static constexpr unsigned kFirst = 4;

    // Reports the time of a picture at this level, ms.
    void drawn(unsigned level, double milliseconds);

    // Returns the level for the next picture in motion. It becomes coarser at once if a picture
    // took longer than kAim, and finer after several in a row that took so little that twice the
    // work would still fit. A finer level that proves too slow is tried less often.
    unsigned moving() const { return moving_; }

    // Returns the level that replaces a picture of level `shown` after it has stood still for
    // `seconds`, or `shown` if it is too early. The wait grows with the expected time of the finer
    // picture, because a picture in progress cannot be stopped.
    unsigned still(unsigned shown, double seconds) const;

    // Whether two coarsest pictures in a row took too long for motion to be visible.
    bool crawls() const { return crawling_ >= 2; }

    // Returns the expected time of a level, ms.
    double expected(unsigned level) const;

private:
    std::array<double, kPreviewLevels.size()> took_{};  // last time in ms; 0: unknown
    unsigned moving_ = 0;
    unsigned calm_ = 0;  // consecutive fast pictures
    unsigned patience_ = kPatience;
    unsigned crawling_ = 0;  // consecutive coarsest pictures slower than kCrawl
    bool tried_finer_ = false;  // the last change was to a finer level

    static constexpr unsigned kPatience = 4;
};

// ---- Times of a drag ----------------------------------------------------------------------------

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

}  // namespace benchmarks::viewer
