#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace benchmarks {

// The keyword of the scene in the texts of a screenshot's PNG.
inline constexpr std::string_view kSceneKeyword = "hairbench-scene";

// The scene, JSON text, in a PNG; none where there is none. Throws engine::Error for what is no
// whole PNG.
std::optional<std::string> sceneOfScreenshot(const std::filesystem::path& path);

}  // namespace benchmarks
