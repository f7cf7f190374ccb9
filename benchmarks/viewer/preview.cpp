#include "benchmarks/viewer/preview.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace benchmarks::viewer {
namespace {

constexpr float kCoarsestLod = 8.0f;  // limit of /lod/level

// A level takes at most 2.5 times the work of the next coarser one.
constexpr double kLittle = 0.4 * PreviewControl::kAim;
constexpr double kClearlyWithin = 0.8 * PreviewControl::kAim;
constexpr unsigned kMostPatience = 256;  // pictures

// ms. A picture that is refined within this time hardly delays the user's next move.
constexpr double kAtOnce = 250.0;
constexpr double kShareOfWait = 0.25;  // share of a picture's time to wait before it is drawn
constexpr double kShortestWait = 0.15;  // s
constexpr double kLongestWait = 3.0;

// Thesis 2.3.8.1, as in hair/rendering/strand_plan.cpp for every root.
float lodAtTarget(const hair::LodSettings& lod, const hair::CameraSettings& camera) {
    if (lod.mode == hair::LodMode::forced) return lod.level;
    const float distance = glm::length(camera.position - camera.target);
    if (distance <= lod.near_distance || lod.far_distance <= lod.near_distance) return 0.0f;
    const float share =
        std::log2(distance / lod.near_distance) / std::log2(lod.far_distance / lod.near_distance);
    return lod.maximum_level * std::min(share, 1.0f);
}

std::uint32_t scaled(std::uint32_t pixels, float share) {
    return std::max(
        static_cast<std::uint32_t>(std::lround(static_cast<float>(pixels) * share)), 1u);
}

}  // namespace

// ---- Levels -------------------------------------------------------------------------------------

hair::Settings previewSettings(const hair::Settings& settings, unsigned level) {
    hair::Settings coarse = settings;
    if (level == 0) return coarse;
    const PreviewLevel& preview = kPreviewLevels[std::min(level, kCoarsestPreview)];
    coarse.lod.level =
        std::min(lodAtTarget(settings.lod, settings.camera) + preview.coarser, kCoarsestLod);
    coarse.lod.mode = hair::LodMode::forced;
    coarse.render.width = scaled(settings.render.width, preview.across);
    coarse.render.height = scaled(settings.render.height, preview.across);
    coarse.render.msaa = 1;
    coarse.render.ssaa = 1;
    return coarse;
}

std::string
previewText(unsigned level, double strand_share, std::uint32_t width, std::uint32_t height) {
    const double percent = 100.0 * strand_share;
    const std::string share =
        percent > 0.0 && percent < 1.0 ? "under 1" : std::to_string(std::lround(percent));
    return "preview, level " + std::to_string(level) + " of " + std::to_string(kCoarsestPreview) +
           ": " + share + " % of strands at " + std::to_string(width) + " × " +
           std::to_string(height);
}

// ---- Choice of the level ------------------------------------------------------------------------

double PreviewControl::expected(unsigned level) const {
    double factor = 1.0;
    for (unsigned coarser = level; coarser <= kCoarsestPreview; ++coarser, factor *= 2.0)
        if (took_[coarser] > 0.0) return took_[coarser] * factor;
    return 0.0;
}

void PreviewControl::drawn(unsigned level, double milliseconds) {
    if (level > kCoarsestPreview || !(milliseconds > 0.0)) return;
    took_[level] = milliseconds;
    crawling_ = level == kCoarsestPreview && milliseconds > kCrawl ? crawling_ + 1 : 0;
    if (level != moving_) {
        // A finer picture was drawn while nothing moved, so the next move may start at its level.
        if (level < moving_ && milliseconds < kClearlyWithin) {
            moving_ = level;
            calm_ = 0;
        }
        // Nothing is known yet about pictures in motion.
        while (moving_ < level && took_[moving_] == 0.0 && expected(moving_) > kAim) ++moving_;
        return;
    }
    if (milliseconds > kAim) {
        const double halvings = std::ceil(std::log2(milliseconds / kAim));
        const unsigned steps =
            static_cast<unsigned>(std::clamp(halvings, 1.0, double{kCoarsestPreview}));
        if (tried_finer_) patience_ = std::min(2 * patience_, kMostPatience);
        moving_ = std::min(moving_ + steps, kCoarsestPreview);
        calm_ = 0;
        tried_finer_ = false;
        return;
    }
    if (milliseconds >= kLittle) {
        calm_ = 0;
        return;
    }
    if (moving_ == 0 || ++calm_ < patience_) return;
    --moving_;
    calm_ = 0;
    tried_finer_ = true;
}

unsigned PreviewControl::still(unsigned shown, double seconds) const {
    if (shown == 0) return 0;
    unsigned next = shown - 1;
    for (unsigned finer = 0; finer < next; ++finer)
        if (expected(finer) <= kAtOnce) next = finer;
    const double wait =
        std::clamp(kShareOfWait * expected(next) / 1000.0, kShortestWait, kLongestWait);
    return seconds >= wait ? next : shown;
}

}  // namespace benchmarks::viewer
