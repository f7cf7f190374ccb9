#include "benchmarks/run/picture_folder.h"

#include <algorithm>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

namespace benchmarks {

namespace {

namespace fs = std::filesystem;

// "12.png", or what a run that was killed left of writing it; anything else is the user's.
bool isCasePicture(const std::string& name) {
    const std::size_t digits = name.find_first_not_of("0123456789");
    return digits != 0 && digits != std::string::npos &&
           (name.substr(digits) == ".png" || name.substr(digits) == ".png.partial");
}

}  // namespace

void removeOtherPictures(const Json& report, const fs::path& path) {
    std::set<std::string> named;
    for (const Json& each : report.at("cases"))
        if (each.contains("picture"))
            named.insert(fs::path(each.at("picture").get<std::string>()).filename().string());
    const fs::path folder = path.parent_path() / (path.stem().string() + ".pictures");
    std::error_code ignored;
    std::set<fs::path> stale;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (const std::string name = entry.path().filename().string();
            isCasePicture(name) && !named.contains(name))
            stale.insert(entry.path());
    for (const fs::path& file : stale) fs::remove(file, ignored);
    fs::remove(folder, ignored);  // if it is empty
}

}  // namespace benchmarks
