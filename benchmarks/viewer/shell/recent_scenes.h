#pragma once

#include <filesystem>
#include <optional>
#include <span>

namespace benchmarks {

// Scenes that were open before, within the current window of Dear ImGui; the one that was chosen.
std::optional<std::filesystem::path> recentScenes(std::span<const std::filesystem::path> scenes);

}  // namespace benchmarks
