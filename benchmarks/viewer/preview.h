#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hair/settings.h"

// Coarser pictures during motion, if whole pictures take too long: the levels, and the choice of
// one.
namespace benchmarks::viewer {

// ---- Levels -------------------------------------------------------------------------------------

// Levels of the picture: the scene's own and the previews, each with about half the work of the one
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

// ---- Choice of the level ------------------------------------------------------------------------

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

}  // namespace benchmarks::viewer
