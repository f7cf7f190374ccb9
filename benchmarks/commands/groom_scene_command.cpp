#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/convert.h"
#include "benchmarks/groom/groom_scene.h"
#include "benchmarks/groom/placement.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"

namespace benchmarks::commands {
namespace {

namespace fs = std::filesystem;

// "hair.json" -> "hair.head.obj"
fs::path convertedHead(const fs::path& scene) {
    fs::path path = scene;
    return path.replace_extension(".head.obj");
}

void refuseToReplace(const fs::path& path, const GroomSceneOptions& options) {
    if (!options.force && fs::exists(path))
        throw engine::Error(path.string(), "exists already; --force replaces it");
}

// Returns the name of a file relative to the scene, as the scene names it.
std::string namedFrom(const fs::path& scene, const fs::path& file) {
    const fs::path folder = fs::absolute(scene).parent_path();
    return fs::absolute(file).lexically_proximate(folder.lexically_normal()).generic_string();
}

bool formatStatesAxes(const fs::path& head) {
    const std::string extension = hair::groom::lowerCaseExtension(head);
    return extension == ".glb" || extension == ".gltf" || extension == ".dae";
}

void tell(const std::string& what, const std::string& text) {
    std::cout << what << ": " << engine::shownText(text) << std::endl;  // flushes early
}

// The head of the scene.
struct SceneHead {
    std::optional<hair::groom::Mesh> mesh;  // metres, +y up
    fs::path file;  // the original file or a converted copy
};

SceneHead headOf(
    const GroomSceneOptions& options, std::optional<hair::groom::Mesh> mesh,
    const groom::LayGuess& guess) {
    if (!mesh) return {};
    tell("head", groom::layText(guess.head) + ". " + guess.head_reason);
    if (guess.head.changesNothing()) return {.mesh = std::move(mesh), .file = options.head};
    const fs::path copy = convertedHead(options.out);
    refuseToReplace(copy, options);
    mesh = groom::placed(*std::move(mesh), guess.head);
    engine::writeFileAtomically(copy, [&](std::ostream& out) { groom::writeObj(*mesh, out); });
    tell("wrote", copy.string() + ": the head in metres, +y up, without its materials");
    return {.mesh = std::move(mesh), .file = copy};
}

std::string descriptionOf(const GroomSceneOptions& options, const groom::LayGuess& guess) {
    std::string text = "Hair of " + options.hair.filename().string() + ", " +
                       groom::layText(guess.hair) + ": " + guess.hair_reason;
    if (!options.head.empty())
        text += " Head of " + options.head.filename().string() + ", " + groom::layText(guess.head) +
                ".";
    return text;
}

constexpr std::uint32_t kViewSize = 320;  // px

// Draws the scene's first frame from each of the views, side by side.
void drawSheet(const GroomSceneOptions& options, const std::vector<hair::CameraSettings>& views) {
    scene::Scene scene =
        scene::loadScene(options.out, scene::Outside::allowed);  // the user chose hair and head
    measure::HairCache cache = measure::userHairCache(true);
    hair::Settings settings =
        scene::singleCase(scene, {.scene = options.out}, &cache.assets()).settings;
    settings.render.width = settings.render.height = kViewSize;
    const engine::Device device(options.device);
    measure::Case picture(device, settings, scene.directory, &cache);
    for (const std::string& warning : measure::inspectStart(picture).warnings)
        std::cerr << "hairbench: " << engine::shownText(warning) << '\n';

    engine::FrameLoop loop(device, engine::Timing::isolated);
    loop.frame([&](engine::Passes& passes) { picture.simulate(passes); });
    const auto width = static_cast<std::uint32_t>(kViewSize * views.size());
    constexpr std::size_t kRow = std::size_t{kViewSize} * 4;  // B
    std::vector<std::uint8_t> sheet(kRow * views.size() * kViewSize);
    for (std::size_t view = 0; view < views.size(); ++view) {
        picture.setCamera(views[view]);
        loop.frame([&](engine::Passes& passes) { picture.draw(passes); });
        const std::vector<std::uint8_t> pixels = picture.picture();
        for (std::size_t row = 0; row < kViewSize; ++row)
            std::copy_n(
                pixels.begin() + static_cast<std::ptrdiff_t>(row * kRow), kRow,
                sheet.begin() + static_cast<std::ptrdiff_t>((row * views.size() + view) * kRow));
    }
    engine::writePng(options.sheet, width, kViewSize, sheet);
    tell("wrote", options.sheet.string() + ": front, left, back and right");
}

// Returns the option needed to open the scene, if hair or head lie outside its reach.
std::string optionsToOpen(const fs::path& scene) {
    try {
        scene::loadScene(scene);
        return {};
    } catch (const engine::Error&) {
        return "--allow-outside ";
    }
}

// Returns the scene's text. Throws Error with the reason if a value lies outside its field's range,
// so that every scene that is written can be read.
std::string documentOf(
    const GroomSceneOptions& options, const hair::Settings& settings,
    const groom::GroomScene& made) {
    const scene::Json document = scene::changedFields(settings);
    try {
        scene::checkSettings(scene::readSettings(document));
    } catch (const engine::Error& error) {
        std::string reasons;
        for (const std::string& warning : made.warnings) reasons += "; " + warning;
        throw engine::Error(
            options.hair.string(),
            std::string("no scene is written, because a value of it would not be valid: ") +
                error.what() + "; the unit (--scale) or the hair's place may be wrong" + reasons);
    }
    return document.dump(2) + '\n';
}

}  // namespace

int makeGroomScene(const GroomSceneOptions& options) {
    refuseToReplace(options.out, options);
    if (!options.sheet.empty()) {
        if (hair::groom::lowerCaseExtension(options.sheet) != ".png")
            throw engine::Error(
                options.sheet.string(), "is not a .png file, the only format that --sheet writes");
        refuseToReplace(options.sheet, options);
    }
    hair::groom::StrandSet strands = hair::groom::importStrands(
        options.hair, options.points_per_strand, {}, hair::groom::badStrands(options.strict));
    strands = chosenGroups(std::move(strands), options.groups, options.hair);
    if (strands.strandCount() == 0)
        throw engine::Error(options.hair.string(), "there are no strands");
    std::optional<hair::groom::Mesh> mesh;
    if (!options.head.empty()) mesh = hair::groom::importMesh(options.head);
    engine::checkWritable(options.out);
    tell(
        "read", options.hair.string() + ", " + report::countText(strands.strandCount(), "strand") +
                    ", " + report::countText(strands.points.size(), "point"));

    groom::LayHints hints{.head_is_stated = formatStatesAxes(options.head)};
    hints.metres_per_unit = options.scale;
    hints.up = groom::axisOf(options.up);
    const groom::LayGuess guess = groom::guessLay(strands, mesh ? &*mesh : nullptr, hints);
    tell("hair", groom::layText(guess.hair) + ". " + guess.hair_reason);
    const SceneHead head = headOf(options, std::move(mesh), guess);

    const double stated = strands.metres_per_unit.value_or(1.0);
    std::vector<std::string> warnings = strands.warnings;
    strands = groom::placed(std::move(strands), guess.hair);
    groom::GroomScene made = groom::sceneOf(strands, head.mesh ? &*head.mesh : nullptr, guess);
    hair::Settings& settings = made.settings;
    settings.description = descriptionOf(options, guess);
    settings.groom.file = namedFrom(options.out, options.hair);
    settings.groom.points_per_strand = options.points_per_strand;
    for (const std::int32_t group : options.groups)
        settings.groom.groups.append(settings.groom.groups.empty() ? "" : ", ")
            .append(std::to_string(group));
    settings.groom.placement.scale = static_cast<float>(guess.hair.metres_per_unit / stated);
    if (head.mesh) settings.groom.mesh = namedFrom(options.out, head.file);
    const std::string document = documentOf(options, settings, made);

    for (const groom::SceneChoice& choice : made.choices) tell(choice.name, choice.reason);
    warnings.insert(warnings.end(), made.warnings.begin(), made.warnings.end());
    for (const std::string& warning : warnings)
        std::cerr << "hairbench: " << engine::shownText(options.hair.string() + ": " + warning)
                  << '\n';
    engine::writeFileAtomically(options.out, document);
    tell(
        "wrote", options.out.string() + "; hairbench render " + optionsToOpen(options.out) +
                     options.out.string() + " -o picture.png");
    if (!options.sheet.empty()) drawSheet(options, made.views);
    return report::kOk;
}

}  // namespace benchmarks::commands
