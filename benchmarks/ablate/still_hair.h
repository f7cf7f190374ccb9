#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "benchmarks/case.h"
#include "hair/rendering/render_assets.h"

namespace benchmarks {

// The hair of a case at a frame, and what else its pictures need.
class StillHair {
public:
    // Simulates up to the frame, which is counted from 0, without pictures. Throws as Case does,
    // and Interrupted.
    StillHair(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory, std::uint32_t frame);

    hair::StrandView view() const { return case_.view(); }
    const hair::RenderAssets& assets() const { return assets_; }
    std::vector<std::pair<std::string, std::uint64_t>> counts() const { return case_.counts(); }

private:
    Case case_;
    std::optional<hair::Mesh> mesh_;
    hair::RenderAssets assets_;
};

}  // namespace benchmarks
