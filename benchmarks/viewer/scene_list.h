#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

// The panel of scenes to open: those of a folder, any other by its path, and recent ones.
namespace benchmarks::viewer {

// A scene file of a folder.
struct ListedScene {
    std::string name;
    std::string description;
    std::string problem;  // why it can't be opened; empty: it can
};
ListedScene listedScene(const std::filesystem::path& path);

// The .json files of a folder but JSON Schemas, sorted by name; none where the folder can't be
// read.
std::vector<std::filesystem::path> sceneFilesIn(const std::filesystem::path& folder);

// The scenes beside the one that is open, and any other by its path: within the current window of
// Dear ImGui.
class SceneList {
public:
    explicit SceneList(const std::filesystem::path& folder);

    // The scene that was chosen. `open` is marked.
    std::optional<std::filesystem::path> show(const std::filesystem::path& open);

private:
    void refresh();
    std::optional<std::filesystem::path> showPath();
    bool showRow(std::size_t index, bool is_open);

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::optional<ListedScene>> scenes_;  // [file], read when they are first in view
    std::array<char, 4096> typed_{};                  // the longest path of a system
    std::array<char, 64> filter_{};
};

// Scenes that were open before, within the current window of Dear ImGui; the one that was chosen.
std::optional<std::filesystem::path> recentScenes(std::span<const std::filesystem::path> scenes);

}  // namespace benchmarks::viewer
