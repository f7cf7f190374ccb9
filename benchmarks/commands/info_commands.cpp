#include <algorithm>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {

std::string shortMessage(const std::exception& error) {
    constexpr std::size_t kLongest = 480;  // leaves room for a prefix
    return engine::shownText(error.what(), kLongest);
}

namespace {

void printStart(
    const engine::Device& device, const std::filesystem::path& path, scene::Scene& scene,
    measure::HairCache& cache, bool is_strict) {
    const scene::CaseSpec spec = scene::singleCase(scene, {.scene = path}, &cache.assets());
    const measure::StartInspection start = [&] {
        const engine::Step step("inspects the hair of " + spec.name);
        const measure::Case first(device, spec.settings, scene.directory, &cache);
        // The case has checked the names of these files.
        const hair::GroomSettings& groom = spec.settings.groom;
        for (const std::string& file : {groom.file, groom.fixed, groom.cache.file})
            if (is_strict && !file.empty())
                hair::groom::importStrands(
                    scene.directory / file, file == groom.file ? groom.points_per_strand : 0, {},
                    hair::groom::BadStrands::refused);
        return measure::inspectStart(first);
    }();
    const report::StartRecord& record = start.record;
    std::cout << "   " << spec.name << ": " << record.from << ", longest segment "
              << record.stretch.value << " of its rest length, deepest vertex "
              << 1e3 * record.depth.value << " mm in a body, fastest " << 1e3 * record.speed.value
              << " mm/s\n";
    if (record.stiffened)
        std::cout << "   balanced: " << *record.stiffened << " guides stiffened, at most "
                  << *record.stiffest << " times; " << *record.unbalanced
                  << " could not be balanced\n";
    for (const std::string& warning : start.warnings)
        std::cout << "   warning: " << engine::shownText(warning) << '\n';
}

}  // namespace

int validateScenes(const ValidateOptions& options) {
    int status = report::kOk;
    std::optional<engine::Device> device;
    if (options.start) device.emplace(options.device);
    measure::HairCache cache = measure::userHairCache(true);
    measure::Progress progress(options.scenes.size());
    for (const std::filesystem::path& path : options.scenes) {
        progress.begin(path.string());
        if (path.string().ends_with(".schema.json")) continue;  // scenes/*.json matches it too
        try {
            std::size_t count = 0;
            std::vector<std::string> warnings;
            std::vector<scene::Scene> loaded = scene::loadScenes(path, options.outside);
            for (scene::Scene& scene : loaded)
                count +=
                    scene::selectCases(scene, {.scene = path}, &cache.assets(), &warnings).size();
            progress.clear();
            for (const std::string& warning : warnings)
                std::cout << "warning: " << engine::shownText(warning) << '\n';
            std::cout << engine::shownText(path.string()) << ": ok, " << count
                      << (count == 1 ? " case\n" : " cases\n");
            if (!device) continue;
            for (scene::Scene& scene : loaded)
                printStart(*device, path, scene, cache, options.strict);
        } catch (const engine::Error& error) {
            progress.clear();
            std::cerr << shortMessage(error) << '\n';
            status = report::kUsageError;
        }
    }
    return status;
}

int printScenes(const ScenesOptions& options) {
    const std::vector<std::string> names = scene::shippedScenes();
    std::size_t widest = 0;
    for (const std::string& name : names) widest = std::max(widest, name.size());
    for (const std::string& name : names) {
        std::cout << name;
        if (!options.names) {
            const std::filesystem::path file = scene::sceneNamed(name);
            std::cout << std::string(widest + 2 - name.size(), ' ')
                      << (scene::isSuite(file) ? "a suite of scenes"
                                               : scene::loadScene(file).settings.description);
        }
        std::cout << '\n';
    }
    return report::kOk;
}

namespace {

// The README of a new scene. `name` is that of its file.
std::string readmeOf(const std::string& name, const std::string& base) {
    return "# " + std::filesystem::path(name).stem().string() + "\n\n`" + name +
           "` changes the scene `" + base +
           "` of hairbench. It names only what differs; `hairbench schema --markdown .` lists "
           "every\n"
           "field with its range, unit and meaning, and an editor completes fields from "
           "scene.schema.json.\n\n"
           "In this folder:\n\n```sh\n"
           "hairbench validate " +
           name +
           "            # checks it and the files that it names\n"
           "hairbench render " +
           name +
           " -o out.png   # draws it; `hairbench view` opens it in a window\n"
           "hairbench run " +
           name +
           " -o out.json     # measures it, and every case of its \"sweep\"\n"
           "```\n";
}

}  // namespace

int makeScene(const NewOptions& options) {
    namespace fs = std::filesystem;
    const std::vector<std::string> names = scene::shippedScenes();
    if (std::ranges::find(names, options.from) == names.end())
        throw engine::Error(
            "--from",
            '\'' + options.from + "' is not a shipped scene; \"hairbench scenes\" lists them");
    if (scene::isSuite(scene::sceneNamed(options.from)))
        throw engine::Error(
            "--from", '\'' + options.from + "' is a suite of scenes; expected a single scene");
    const fs::path folder =
        options.folder.has_filename() ? options.folder : options.folder.parent_path();
    if (std::error_code error; fs::exists(fs::symlink_status(folder, error)))
        throw engine::Error(folder.string(), "exists; expected the name of a new folder");
    const std::string name = folder.filename().string() + ".json";
    const fs::path file = folder / name;
    const scene::Json document = {
        {"$schema", "scene.schema.json"},
        {"base", options.from},
        {"description", "what differs from " + options.from}};
    engine::writeFileAtomically(file, document.dump(2) + '\n');
    engine::writeFileAtomically(folder / "scene.schema.json", scene::sceneSchema());
    engine::writeFileAtomically(folder / "README.md", readmeOf(name, options.from));
    std::cout << engine::shownText(file.string()) << '\n';
    return report::kOk;
}

int printSchema(const SchemaOptions& options) {
    std::cout
        << (options.examples.empty() ? scene::sceneSchema()
                                     : scene::fieldReference(options.examples));
    return report::kOk;
}

namespace {

// Prints features that the device lacks and only some cases need.
void printLacking(const engine::DeviceInfo& device) {
    std::string lacking;
    for (const engine::Feature feature : engine::allFeatures())
        if (!device.features.contains(feature))
            lacking += "\n     " + std::string(engine::featureName(feature));
    if (!lacking.empty()) std::cout << "   can't run cases that need" << lacking << '\n';
}

}  // namespace

int printDevices() {
    const engine::Instance instance(engine::Validation::off);
    const std::vector<engine::DeviceInfo> devices = engine::listDevices(instance);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const engine::DeviceInfo& device = devices[i];
        std::cout << i << ": " << device.name << "\n   " << engine::deviceTypeName(device.type)
                  << ", Vulkan " << device.api_version << ", " << device.driver << ' '
                  << device.driver_version << "\n   timestamps: " << device.timestamp_valid_bits
                  << " bits of " << device.limits.timestampPeriod << " ns\n";
        if (device.missing.empty()) {
            std::cout << "   runs hairbench\n";
            printLacking(device);
        } else {
            std::cout << "   can't run hairbench; it lacks";
            for (const std::string& missing : device.missing) std::cout << "\n     " << missing;
            std::cout << '\n';
        }
    }
    if (devices.empty()) throw engine::NoDevice("no Vulkan device");
    return report::kOk;
}

}  // namespace benchmarks::commands
