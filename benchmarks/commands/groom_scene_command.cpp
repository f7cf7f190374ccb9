#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/convert.h"
#include "benchmarks/groom/info.h"
#include "benchmarks/groom/placement.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "engine/ui.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/usd_import.h"
#include "hair/groom/inspect.h"
#include "hair/groom/style/style.h"

namespace benchmarks::commands {
namespace {

namespace fs = std::filesystem;

// "hair.json" -> "hair.head.obj"
fs::path besideScene(const fs::path& scene, const char* extension) {
    fs::path path = scene;
    return path.replace_extension(extension);
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
    const fs::path copy = besideScene(options.out, ".head.obj");
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
    if (!options.head.empty()) mesh = meshOf(options.head);
    engine::checkWritable(options.out);
    tell(
        "read", options.hair.string() + ", " + report::countText(strands.strandCount(), "strand") +
                    ", " + report::countText(strands.points.size(), "point"));

    groom::LayHints hints{.head_is_stated = mesh && mesh->is_placed};
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
    if (made.body) {
        const fs::path body = besideScene(options.out, ".body.obj");
        refuseToReplace(body, options);
        engine::writeFileAtomically(
            body, [&](std::ostream& out) { groom::writeObj(*made.body, out); });
        settings.simulation.distance_fields.front().mesh = namedFrom(options.out, body);
        tell("wrote", body.string() + ": the part of the mesh that hair collides with");
    }
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

// ---- Sheet of a data set ------------------------------------------------------------------------

namespace {

constexpr std::string_view kSheetSchema = "hairbench-groom-sheet/1.0.0";
constexpr std::uint32_t kMostDrawn = 4000;  // strands of a picture
constexpr std::uint32_t kGuidesOfPicture = 60;

// "b2" before "b10".
bool isBefore(std::string_view a, std::string_view b) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const auto takeNumber = [&](std::string_view& text) {
        text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
        const auto end = std::ranges::find_if_not(text, isDigit);
        const std::string_view number =
            text.substr(0, static_cast<std::size_t>(end - text.begin()));
        text.remove_prefix(number.size());
        return std::pair(number.size(), number);
    };
    while (!a.empty() && !b.empty()) {
        if (isDigit(a.front()) && isDigit(b.front())) {
            const auto one = takeNumber(a), other = takeNumber(b);
            if (one != other) return one < other;
        } else if (a.front() != b.front()) {
            return a.front() < b.front();
        } else {
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    return a.size() < b.size();
}

bool isOfHair(const fs::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    for (const hair::groom::StrandImporter& importer : hair::groom::strandImporters())
        if (std::ranges::find(importer.extensions, extension) != importer.extensions.end())
            return true;
    return false;
}

// Writes the archive's files of hair into a folder. Their names may be anything, so the files have
// names of their own; returns them with their names in the archive.
std::vector<std::pair<fs::path, std::string>>
unpacked(const fs::path& archive, const fs::path& folder) {
    const engine::Step step("unpacks " + archive.filename().string());
    std::vector<std::string> arguments{fs::absolute(archive).string()};
    for (const hair::groom::StrandImporter& importer : hair::groom::strandImporters())
        arguments.insert(arguments.end(), importer.extensions.begin(), importer.extensions.end());
    constexpr std::uint64_t kMost = std::uint64_t{2} << 30;
    const engine::ChildLimits limits{
        .seconds = static_cast<unsigned>(60 + fs::file_size(archive) / 2'000'000),
        .bytes = 3 * kMost,
        .output = kMost + (std::size_t{64} << 20),
        .reads = std::vector{fs::absolute(archive)}};
    const std::vector<std::byte> bytes = [&] {
        try {
            return hair::groom::runScript(
                {.script = "archive_members.py", .what = "archives", .library = "Python"},
                arguments, limits);
        } catch (const engine::Error& error) {
            throw engine::Error(archive.string(), error.what());
        }
    }();
    std::span<const std::byte> rest(bytes);
    const auto take = [&](std::uint64_t size) {
        if (size > rest.size()) throw engine::Error(archive.string(), "its files end too early");
        const auto taken = rest.first(size);
        rest = rest.subspan(size);
        return std::string_view(reinterpret_cast<const char*>(taken.data()), taken.size());
    };
    std::vector<std::pair<fs::path, std::string>> files;
    while (!rest.empty()) {
        std::array<std::uint64_t, 2> sizes{};
        std::memcpy(sizes.data(), take(sizeof sizes).data(), sizeof sizes);
        const std::string name(take(sizes[0]));
        const fs::path file = folder / (std::to_string(files.size()) +
                                        hair::groom::lowerCaseExtension(fs::path(name)));
        engine::writeFileAtomically(file, take(sizes[1]));
        files.emplace_back(file, name);
    }
    return files;
}

std::vector<std::pair<fs::path, std::string>>
filesOf(const GroomSheetOptions& options, const fs::path& scratch) {
    std::vector<std::pair<fs::path, std::string>> files;
    if (fs::is_directory(options.folder)) {
        const auto skip = fs::directory_options::skip_permission_denied;
        for (const auto& entry : fs::recursive_directory_iterator(options.folder, skip))
            if (entry.is_regular_file() && isOfHair(entry.path()))
                files.emplace_back(
                    entry.path(), entry.path().lexically_relative(options.folder).generic_string());
    } else if (fs::is_regular_file(options.folder)) {
        files = unpacked(options.folder, scratch);
    } else {
        throw engine::Error(options.folder.string(), "is neither a folder nor an archive");
    }
    if (files.empty())
        throw engine::Error(
            options.folder.string(),
            "has no files of hair: their extensions are " + hair::groom::readExtensions());
    std::ranges::sort(
        files, [](const auto& a, const auto& b) { return isBefore(a.second, b.second); });
    return files;
}

// A file of the data set that could be read.
struct Grown {
    std::string name;
    scene::Json info;  // of `groom info --json`
    hair::groom::StrandFindings findings;
    std::vector<std::string> odd;
    groom::LayGuess guess;
    bool up_stated = false;
    std::uint64_t left_out = 0;  // strands
    hair::groom::StrandSet drawn;  // some of the strands, in metres with +y up
    hair::Settings settings;
};

// Returns at most `most` strands that are no guides beside others, at equal distances.
hair::groom::StrandSet drawnOf(const hair::groom::StrandSet& strands, std::uint32_t most) {
    const bool has_others = std::ranges::count(strands.guides, 0) > 0;
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < strands.strandCount(); ++i)
        if (!has_others || strands.guides[i] == 0) all.push_back(i);
    std::vector<std::uint32_t> chosen;
    const std::size_t count = std::min<std::size_t>(most, all.size());
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
    return hair::groom::pickStrands(strands, chosen);
}

Grown grownOf(
    const fs::path& file, const std::string& name, const hair::groom::Mesh* mesh,
    const GroomSheetOptions& options) {
    hair::groom::StrandSet strands = hair::groom::importStrands(
        file, options.points_per_strand, {}, hair::groom::badStrands(options.strict));
    if (strands.strandCount() == 0) throw engine::Error("there are no strands");
    groom::LayHints hints{.head_is_stated = mesh && mesh->is_placed};
    hints.metres_per_unit = options.scale;
    hints.up = groom::axisOf(options.up);
    Grown grown{.name = name, .guess = groom::guessLay(strands, mesh, hints)};
    grown.findings = hair::groom::inspect(strands, nullptr, options.scale);
    grown.up_stated = strands.up.has_value() || hints.up.has_value();
    const groom::GroomInfo info{
        .file = name,
        .format = hair::groom::strandImporterOf(file).name,
        .strands = strands,
        .findings = grown.findings,
        .oddities = groom::findOddities(strands, grown.findings)};
    grown.info = scene::Json::parse(groom::groomInfoJson(info));
    for (const groom::Oddity& odd : info.oddities)
        if (odd.name != "unit") grown.odd.push_back(odd.what);  // the table has it
    for (const std::string& warning : strands.warnings) grown.odd.push_back(warning);
    for (const hair::groom::LeftOutStrands& each : strands.left_out) grown.left_out += each.count;
    strands = groom::placed(std::move(strands), grown.guess.hair);
    std::optional<hair::groom::Mesh> head;
    if (mesh) head = groom::placed(*mesh, grown.guess.head);
    grown.drawn = drawnOf(strands, kMostDrawn);
    const groom::GroomScene made = groom::sceneOf(strands, head ? &*head : nullptr, grown.guess);
    if (mesh && grown.guess.best)
        grown.info["head"] = {{"roots_on_it", grown.guess.best->fit.share}};
    hair::Settings& settings = grown.settings = made.settings;
    settings.groom = {
        .vertices = std::min(settings.groom.vertices, 24u),
        .guides = std::min(kGuidesOfPicture, grown.drawn.strandCount())};
    settings.simulation = {.solver = hair::Solver::none};
    settings.strands.source = hair::StrandSource::groom;
    settings.strands.collision = hair::StrandCollision::none;
    settings.strands.width = hair::WidthSource::scene;
    // As much coverage as 100,000 hairs of 0.08 mm.
    settings.strands.root_width = std::clamp(8.0f / float(grown.drawn.strandCount()), 6e-5f, 2e-3f);
    settings.strands.tip_width = 0.5f * settings.strands.root_width;
    settings.render.width = settings.render.height = options.size;
    return grown;
}

// The pictures in rows, each with two lines of text below it.
class Sheet {
public:
    Sheet(std::size_t count, std::uint32_t size, std::uint32_t columns)
        : size_(size), columns_(
                           columns > 0 ? columns
                                       : static_cast<std::uint32_t>(std::ceil(
                                             std::sqrt(1.2 * static_cast<double>(count))))),
          name_(size < 200 ? 11.0f : 15.0f), detail_(size < 200 ? 10.0f : 12.0f),
          text_height_(size < 200 ? 32 : 42) {
        columns_ = std::min(columns_, static_cast<std::uint32_t>(count));
        const auto rows = static_cast<std::uint32_t>((count + columns_ - 1) / columns_);
        picture_.width = columns_ * (size_ + kGap) + kGap;
        picture_.height = rows * (size_ + text_height_ + kGap) + kGap;
        engine::checkPictureSize(picture_.width, picture_.height);
        for (std::size_t i = 0; i < std::size_t{picture_.width} * picture_.height; ++i)
            picture_.rgba.insert(picture_.rgba.end(), {28, 28, 30, 255});
    }

    // `pixels` are empty for hair that can't be drawn.
    void
    add(std::size_t index, std::span<const std::uint8_t> pixels, const std::string& name,
        const std::string& detail) {
        const auto column = static_cast<std::uint32_t>(index % columns_);
        const auto row = static_cast<std::uint32_t>(index / columns_);
        const std::uint32_t left = kGap + column * (size_ + kGap);
        const std::uint32_t top = kGap + row * (size_ + text_height_ + kGap);
        for (std::uint32_t y = 0; y < size_ && !pixels.empty(); ++y)
            std::ranges::copy(
                pixels.subspan(std::size_t{y} * size_ * 4, std::size_t{size_} * 4),
                picture_.rgba.begin() + static_cast<std::ptrdiff_t>(
                                            4 * (std::size_t{top + y} * picture_.width + left)));
        const auto x = static_cast<float>(left);
        const auto y = static_cast<float>(top + size_);
        name_.draw(picture_, x, y + 3.0f, fitted(name_, name), {235, 235, 235});
        detail_.draw(
            picture_, x, y + 0.52f * static_cast<float>(text_height_), fitted(detail_, detail),
            {165, 165, 170});
    }

    void write(const fs::path& file) const {
        engine::writePng(file, picture_.width, picture_.height, picture_.rgba);
    }

private:
    // Returns the text, or its beginning and its end, as wide as a picture.
    std::string fitted(const engine::TextPainter& painter, const std::string& text) const {
        const auto most = static_cast<float>(size_);
        if (painter.width(text) <= most) return text;
        for (std::size_t kept = text.size(); kept > 2; --kept) {
            const std::size_t end = kept / 2;
            const std::string shorter =
                text.substr(0, kept - end) + "..." + text.substr(text.size() - end);
            if (painter.width(shorter) <= most) return shorter;
        }
        return {};
    }

    static constexpr std::uint32_t kGap = 8;  // px

    std::uint32_t size_;
    std::uint32_t columns_;
    engine::TextPainter name_;
    engine::TextPainter detail_;
    std::uint32_t text_height_;
    engine::Pixels picture_;
};

std::vector<std::uint8_t>
pictureOf(const engine::Device& device, const Grown& grown, const fs::path& folder) {
    hair::groom::exportStrands(grown.drawn, folder / "drawn.hair");
    hair::Settings settings = grown.settings;
    settings.groom.file = "drawn.hair";
    measure::Case picture(device, settings, folder);
    engine::FrameLoop loop(device, engine::Timing::isolated);
    loop.frame([&](engine::Passes& passes) { picture.simulate(passes); });
    loop.frame([&](engine::Passes& passes) { picture.draw(passes); });
    return picture.picture();
}

std::string unitOf(const Grown& grown) {
    return grown.findings.unit + (grown.findings.unit_stated ? "" : "?");
}

std::string upOf(const Grown& grown) {
    return std::string("+") + groom::axisName(grown.guess.hair.up) + (grown.up_stated ? "" : "?");
}

// Finds the value that most have; empty if fewer than three of four have it.
std::string commonest(const std::vector<Grown>& all, std::string (*valueOf)(const Grown&)) {
    std::map<std::string, std::size_t> counts;
    for (const Grown& grown : all) ++counts[valueOf(grown)];
    const auto most =
        std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; });
    return 4 * most->second >= 3 * all.size() ? most->first : "";
}

// Files of a data set are in one unit and one orientation.
void findOthers(std::vector<Grown>& all) {
    const std::pair<std::string (*)(const Grown&), const char*> kinds[] = {
        {unitOf, "unit"}, {upOf, "upward axis"}};
    for (const auto& [valueOf, what] : kinds) {
        const std::string usual = commonest(all, valueOf);
        for (Grown& grown : all)
            if (!usual.empty() && valueOf(grown) != usual)
                grown.odd.push_back(
                    std::string("its ") + what + " is " + valueOf(grown) + ", that of most files " +
                    usual);
    }
}

void printSheet(const std::vector<Grown>& all, bool has_head) {
    std::vector<report::Column> columns{
        {.title = "file", .numeric = false},
        {.title = "strands"},
        {.title = "points"},
        {.title = "guides"},
        {.title = "groups"},
        {.title = "unit", .numeric = false},
        {.title = "up", .numeric = false},
        {.title = "median length"},
        {.title = "strays"},
        {.title = "left out"}};
    if (has_head) columns.push_back({.title = "on the head"});
    for (const Grown& grown : all) {
        std::vector<std::string> cells{
            engine::shownText(grown.name),
            report::countText(grown.findings.strands),
            report::countText(grown.findings.points),
            report::countText(grown.info["has"]["guides"].get<std::uint64_t>()),
            report::countText(grown.info["has"]["groups"].get<std::uint64_t>()),
            unitOf(grown),
            upOf(grown),
            report::lengthText(grown.findings.lengths.median * grown.guess.hair.metres_per_unit),
            report::countText(grown.findings.strays.size()),
            report::countText(grown.left_out)};
        if (has_head)
            cells.push_back(grown.guess.best ? report::shareText(grown.guess.best->fit.share) : "");
        for (std::size_t i = 0; i < cells.size(); ++i)
            columns[i].cells.push_back(std::move(cells[i]));
    }
    std::cout << report::columnsText(columns);
    bool is_first = true;
    for (const Grown& grown : all) {
        if (grown.odd.empty()) continue;
        if (std::exchange(is_first, false)) std::cout << "\nodd:\n";
        std::cout << "  " << engine::shownText(grown.name) << '\n';
        for (const std::string& odd : grown.odd)
            std::cout << "      " << engine::shownText(odd) << '\n';
    }
}

}  // namespace

int makeGroomSheet(const GroomSheetOptions& options) {
    if (hair::groom::lowerCaseExtension(options.out) != ".png")
        throw engine::Error(options.out.string(), "is not a .png file, the only format of sheets");
    for (const fs::path& file : {options.out, options.json})
        if (!file.empty()) {
            if (!options.force && fs::exists(file))
                throw engine::Error(file.string(), "exists already; --force replaces it");
            engine::checkWritable(file);
        }
    std::optional<hair::groom::Mesh> head;
    if (!options.head.empty()) head = meshOf(options.head);
    const engine::ScratchFolder scratch;
    std::vector<std::pair<fs::path, std::string>> files = filesOf(options, scratch.path());
    const std::size_t found = files.size();
    if (found > options.most) {
        std::vector<std::pair<fs::path, std::string>> some;
        for (std::size_t i = 0; i < options.most; ++i)
            some.push_back(files[i * found / options.most]);
        files = std::move(some);
    }

    const engine::Device device(options.device);
    std::vector<Grown> all;
    std::vector<std::vector<std::uint8_t>> pictures;
    scene::Json refused = scene::Json::array();
    {
        measure::Progress progress(files.size());
        for (const auto& [file, name] : files) {
            progress.begin(name);
            try {
                all.push_back(grownOf(file, name, head ? &*head : nullptr, options));
            } catch (const engine::Error& error) {
                std::string reason = error.what();
                if (reason.starts_with(file.string() + ": "))
                    reason.erase(0, file.string().size() + 2);
                refused.push_back({{"file", name}, {"reason", reason}});
                continue;
            }
            pictures.emplace_back();
            try {
                pictures.back() = pictureOf(device, all.back(), scratch.path());
            } catch (const engine::Error& error) {
                all.back().odd.push_back(std::string("can't be drawn: ") + error.what());
            }
            all.back().drawn = {};
        }
        progress.clear();
    }
    if (all.empty())
        throw engine::Error(
            options.folder.string(), "none of its " + report::countText(found, "file") +
                                         " can be read; the first, " +
                                         refused[0]["file"].get<std::string>() + ": " +
                                         refused[0]["reason"].get<std::string>());
    findOthers(all);
    printSheet(all, head.has_value());
    if (!refused.empty()) std::cout << "\nnot read:\n";
    for (const scene::Json& each : refused)
        std::cout << "  " << engine::shownText(each["file"].get<std::string>()) << "\n      "
                  << engine::shownText(each["reason"].get<std::string>()) << '\n';
    if (files.size() < found)
        std::cout << '\n'
                  << report::countText(files.size()) << " of " << report::countText(found, "file")
                  << ", at equal distances; --most reads more\n";

    Sheet sheet(all.size(), options.size, options.columns);
    scene::Json grooms = scene::Json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Grown& grown = all[i];
        sheet.add(
            i, pictures[i], engine::shownText(grown.name),
            report::countText(grown.findings.strands, "strand") + ", " + unitOf(grown) + ", " +
                upOf(grown) +
                (grown.odd.empty() ? "" : ", " + std::to_string(grown.odd.size()) + " odd"));
        scene::Json groom = grown.info;
        groom.erase("schema");
        groom["findings"] = grown.odd;
        groom["placed"] = {
            {"metres_per_unit", grown.guess.hair.metres_per_unit},
            {"up", groom::axisName(grown.guess.hair.up)}};
        grooms.push_back(std::move(groom));
    }
    std::cout << '\n';
    sheet.write(options.out);
    tell("wrote", options.out.string());
    if (!options.json.empty()) {
        const scene::Json document{
            {"schema", kSheetSchema},
            {"folder", options.folder.string()},
            {"files", found},
            {"grooms", grooms},
            {"refused", refused}};
        engine::writeFileAtomically(
            options.json,
            document.dump(2, ' ', false, scene::Json::error_handler_t::replace) + '\n');
        tell("wrote", options.json.string());
    }
    return report::kOk;
}

}  // namespace benchmarks::commands
