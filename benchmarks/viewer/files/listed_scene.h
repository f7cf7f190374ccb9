#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace benchmarks {

// A file of a folder of scenes.
struct ListedScene {
    std::string name;
    std::string description;
    std::string problem;  // why it can't be opened; empty: it can
};
ListedScene listedScene(const std::filesystem::path& path);

// The .json files of a folder but JSON Schemas, by name; none where it can't be read.
std::vector<std::filesystem::path> sceneFilesIn(const std::filesystem::path& folder);

}  // namespace benchmarks
