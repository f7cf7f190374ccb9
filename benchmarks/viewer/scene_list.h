#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

// The panel of scenes to open: those of a folder, any other by its path, and recent ones.
namespace benchmarks::viewer {

// A scene file in a folder.
struct ListedScene {
    std::string name;
    std::string description;
    std::string problem;  // why it cannot be opened; empty if it can
};
ListedScene listedScene(const std::filesystem::path& path);

// Returns the .json files of a folder except JSON Schemas, sorted by name; none if the folder
// cannot be read.
std::vector<std::filesystem::path> sceneFilesIn(const std::filesystem::path& folder);

// Lists the scenes beside the open one, within the current Dear ImGui window, and accepts any other
// by its path.
class SceneList {
public:
    explicit SceneList(const std::filesystem::path& folder);

    // Returns the chosen scene, if any. Marks the scene `open`.
    std::optional<std::filesystem::path> show(const std::filesystem::path& open);

private:
    void refresh();
    std::optional<std::filesystem::path> showPath();
    bool showRow(std::size_t index, bool is_open);

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::optional<ListedScene>> scenes_;  // [file], read when first visible
    std::array<char, 4096> typed_{};  // the system's longest path
    std::array<char, 64> filter_{};
};

// Shows recent scenes within the current Dear ImGui window. Returns the chosen one, if any.
std::optional<std::filesystem::path> recentScenes(std::span<const std::filesystem::path> scenes);

}  // namespace benchmarks::viewer
