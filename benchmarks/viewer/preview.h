#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hair/settings.h"

// Coarser pictures while something moves that takes too long to be drawn whole: which levels there
// are, and which one is drawn.
namespace benchmarks::viewer {

// ---- Levels -------------------------------------------------------------------------------------

// The scene's own picture and the previews, each about half as much work as the one before: half of
// the strands and of their segments (/lod), and fewer pixels, since strands grow wider as they grow
// fewer. One sample per pixel.
struct PreviewLevel {
    float coarser = 0.0f;  // added to the level of detail
    float across = 1.0f;  // share of the pixels, along either side of the picture
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

// The settings that a level is drawn with. Those of level 0 are the same; others differ in /lod and
// /render alone. Levels of detail that go by distance become the one at the camera's target.
hair::Settings previewSettings(const hair::Settings& settings, unsigned level);

// "preview, level 3 of 7: 12 % of strands at 480 × 270"
std::string
previewText(unsigned level, double strand_share, std::uint32_t width, std::uint32_t height);

// ---- Which level is drawn -----------------------------------------------------------------------

// Chooses levels by what pictures took. A function of what it was told alone: it asks no clock.
class PreviewControl {
public:
    static constexpr double kAim = 100.0;  // ms that a picture that moves should take at most

    static constexpr double kCrawl = 1000.0;  // ms

    // The level of a scene's first picture, of which nobody knows how long it takes: it is there
    // soon, and a finer one soon after it wherever that is fast.
    static constexpr unsigned kFirst = 4;

    // A picture of this level took so long, ms.
    void drawn(unsigned level, double milliseconds);

    // The level for the next picture while something moves. It becomes coarser at once where a
    // picture took longer than kAim, and finer where several in a row took so little that twice as
    // much work would still fit. A finer level that turns out too slow is tried less often.
    unsigned moving() const { return moving_; }

    // The level that a picture of level `shown` is to give way to once it has stood still for so
    // many s; `shown` itself where it is too early. The longer a finer one is expected to take, the
    // longer it waits: nothing can end a picture that is being drawn.
    unsigned still(unsigned shown, double seconds) const;

    // Whether even the coarsest pictures take so long, two in a row, that nobody sees them move.
    bool crawls() const { return crawling_ >= 2; }

    // ms that a level is expected to take.
    double expected(unsigned level) const;

private:
    std::array<double, kPreviewLevels.size()> took_{};  // ms, the last time; 0: not known
    unsigned moving_ = 0;
    unsigned calm_ = 0;  // pictures in a row that took little
    unsigned patience_ = kPatience;
    unsigned crawling_ = 0;  // coarsest pictures in a row that took longer than kCrawl
    bool tried_finer_ = false;  // the last change of level was to a finer one

    static constexpr unsigned kPatience = 4;
};

}  // namespace benchmarks::viewer
