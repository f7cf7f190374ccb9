#include "benchmarks/viewer/files/listed_scene.h"

#include <algorithm>

#include "benchmarks/scene.h"
#include "engine/error.h"

namespace benchmarks {

namespace fs = std::filesystem;

std::vector<fs::path> sceneFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator each(folder.empty() ? fs::path(".") : folder, error), end;
         !error && each != end; each.increment(error)) {
        const std::string name = each->path().filename().string();
        std::error_code ignored;
        if (name.ends_with(".json") && !name.ends_with(".schema.json") &&
            each->is_regular_file(ignored))
            files.push_back(folder / name);
    }
    std::ranges::sort(files);
    return files;
}

ListedScene listedScene(const fs::path& path) {
    ListedScene listed{.name = path.stem().string()};
    try {
        listed.description = loadScene(path).settings.description;
    } catch (const engine::Error& error) {
        listed.problem = error.what();
    }
    return listed;
}

}  // namespace benchmarks
