#include "benchmarks/report/baseline.h"

#include <cstdlib>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/report/report.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::report {
namespace {

std::filesystem::path baselineFolder() {
    const char* const folder = std::getenv("HAIRBENCH_BASELINES");
    return folder && *folder ? folder : "results/local/baselines";
}

// Throws engine::Error unless the name is a valid folder name on every system. It must not lead out
// of the baselines' folder.
void checkName(const std::string& name) {
    if (name.empty() || name.starts_with('.') || name.starts_with('-'))
        throw engine::Error(
            "baseline",
            "'" + name + "' is not a name: it must not be empty or begin with '.' or '-'");
    for (const char each : name)
        if (std::string_view("/\\:*?\"<>|").find(each) != std::string_view::npos ||
            static_cast<unsigned char>(each) < 32)
            throw engine::Error(
                "baseline", "'" + name +
                                "' is not a name: it must be one of a single folder, without '/' "
                                "or control characters");
}

}  // namespace

std::filesystem::path baselineFile(const std::string& name, const std::string& scene) {
    checkName(name);
    return baselineFolder() / name / (scene + ".json");
}

std::string sceneNameOf(const scene::Json& report) {
    const std::string path = scene::textAt(report, "/scene/path");
    if (path.empty()) throw engine::Error("/scene/path", "the report names no scene");
    return std::filesystem::path(path).stem().string();
}

void saveBaseline(const std::string& name, const std::filesystem::path& report) {
    scene::Json copy = readReport(report);
    for (scene::Json& each : copy.at("cases"))
        each.erase("picture");  // its path is relative to the report
    // Texts from drivers and the command line need not be UTF-8.
    engine::writeFileAtomically(
        baselineFile(name, sceneNameOf(copy)),
        copy.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n');
}

}  // namespace benchmarks::report
