#include "benchmarks/viewer/scene_file.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/text.h"
#include "benchmarks/scene/axis.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/settings_json.h"
#include "benchmarks/scene/sweep.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "engine/png_text.h"
#include "hair/fields.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/ply.h"
#include "hair/groom/formats/text.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/gltf_model.h"
#include "hair/groom/mesh/import_mesh.h"
#include "hair/groom/mesh/surface.h"

namespace benchmarks::viewer {
namespace {

namespace fs = std::filesystem;

// ---- Settings as arguments of the command line --------------------------------------------------

struct Argument {
    std::string pointer;
    scene::Json value;
    bool in_name;  // -a, otherwise --set
};

// Whether the command line reads the text as a string: it is not JSON and has no special characters
// of the axis parser.
bool isPlain(const std::string& text) {
    constexpr std::string_view kFirst = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_./";
    const std::string allowed = std::string(kFirst) + "0123456789-";
    return !text.empty() && kFirst.find(text[0]) != std::string_view::npos &&
           text.find_first_not_of(allowed) == std::string::npos && !scene::Json::accept(text);
}

std::string valueText(const scene::Json& value) {
    if (value.is_string() && isPlain(value.get_ref<const std::string&>()))
        return value.get<std::string>();
    return value.dump();
}

std::string quoted(const std::string& word) {
    const auto safe = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
               std::string_view("_-+=:,./@%").find(c) != std::string_view::npos;
    };
    if (std::ranges::all_of(word, safe)) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + '\'';
}

bool isInside(const std::string& pointer, const std::string& outer) {
    return pointer == outer || pointer.starts_with(outer + '/');
}

// Returns the sweep's axes, each with its single value in the settings.
std::vector<Argument> axisArguments(const scene::Scene& scene, const hair::Settings& settings) {
    std::vector<Argument> arguments;
    for (const scene::Axis& axis : scene.axes) {
        if (!axis.tied.empty())
            throw engine::Error(
                "the sweep changes " + axis.pointer +
                " together with other fields, which a command line can't express; save a scene "
                "instead");
        arguments.push_back({axis.pointer, scene::valueAt(settings, axis.pointer), true});
    }
    return arguments;
}

// Adds the fields that differ and are not axes.
void addChanges(
    const scene::Json& original, const scene::Json& wanted, const std::string& pointer,
    const std::vector<scene::Axis>& axes, std::vector<Argument>& arguments) {
    const auto has_it = [&](const scene::Axis& axis) { return isInside(pointer, axis.pointer); };
    if (std::ranges::any_of(axes, has_it)) return;
    if (wanted.is_object()) {
        for (const auto& [key, value] : wanted.items())
            addChanges(
                original.value(key, scene::Json()), value, pointer + '/' + scene::escapedToken(key),
                axes, arguments);
        return;
    }
    if (original.dump() == wanted.dump()) return;
    const bool is_list = wanted.is_array() && (wanted.empty() || wanted[0].is_object());
    arguments.push_back({pointer, wanted, !is_list && pointer != "/description"});
}

// Removes members with default values from lists.
void shorten(std::vector<Argument>& arguments, const hair::Settings& settings) {
    const scene::Json changed = scene::changedFields(settings);
    for (Argument& argument : arguments) {
        if (argument.in_name) continue;
        const scene::Json::json_pointer pointer(argument.pointer);
        if (changed.contains(pointer)) argument.value = changed.at(pointer);
    }
}

// Throws engine::Error unless the arguments reproduce the settings exactly.
void check(scene::Scene scene, const std::vector<Argument>& arguments, const scene::Json& wanted) {
    std::vector<scene::Axis> axes;
    for (const Argument& argument : arguments) {
        if (argument.in_name)
            axes.push_back(scene::parseAxis(argument.pointer + '=' + valueText(argument.value)));
        else
            scene::setField(scene, argument.pointer, argument.value);
    }
    const std::vector<scene::CaseSpec> cases = scene::expand(scene, axes);
    if (cases.size() != 1 || scene::writeSettings(cases.front().settings).dump() != wanted.dump())
        throw engine::Error(
            scene.path.string(), "a command line can't express it; save a scene instead");
}

// ---- Readable JSON ------------------------------------------------------------------------------

constexpr std::size_t kColumns = 100;
constexpr std::size_t kIndent = 2;

std::string keyText(const std::string& key) { return scene::Json(key).dump() + ": "; }

std::string onOneLine(const scene::Json& value) {
    if (!value.is_structured() || value.empty()) return value.dump();
    std::string text;
    for (const auto& [key, member] : value.items()) {
        if (!text.empty()) text += ", ";
        if (value.is_object()) text += keyText(key);
        text += onOneLine(member);
    }
    return value.is_object() ? "{ " + text + " }" : '[' + text + ']';
}

std::string onLines(const scene::Json& value, std::size_t indent);

// `column` is the column at which the text begins.
std::string text(const scene::Json& value, std::size_t indent, std::size_t column) {
    std::string line = onOneLine(value);
    constexpr std::size_t kComma = 1;
    if (!value.is_structured() || value.empty() || column + line.size() + kComma <= kColumns)
        return line;
    return onLines(value, indent);
}

std::string onLines(const scene::Json& value, std::size_t indent) {
    const std::string margin(indent + kIndent, ' ');
    std::string lines;
    for (const auto& [key, member] : value.items()) {
        if (!lines.empty()) lines += ',';
        const std::string name = value.is_object() ? keyText(key) : "";
        lines += '\n' + margin + name;
        lines += text(member, indent + kIndent, margin.size() + name.size());
    }
    lines += '\n' + std::string(indent, ' ');
    return value.is_object() ? '{' + lines + '}' : '[' + lines + ']';
}

// ---- Scenes, opened and saved -------------------------------------------------------------------

constexpr const char* kSchema = "scene.schema.json";

// Returns a folder's path with links resolved, so that ".." stays correct.
fs::path folderOf(const fs::path& folder) {
    return fs::weakly_canonical(fs::absolute(folder.empty() ? fs::path(".") : folder));
}

// ---- Files dropped on the window ----------------------------------------------------------------

// Whether a picture contains a scene. A damaged scene counts, because opening it reports the error.
bool hasScene(const fs::path& picture) {
    try {
        return scene::sceneOfScreenshot(picture).has_value();
    } catch (const engine::Error&) {
        return true;
    }
}

bool isMesh(const std::string& extension) {
    return std::ranges::any_of(
        hair::groom::meshImporters(), [&](const hair::groom::MeshImporter& importer) {
            return std::ranges::count(importer.extensions, extension) > 0;
        });
}

bool isGroom(const fs::path& file) {
    try {
        hair::groom::strandImporterOf(file);  // recognises some by their first bytes
        return true;
    } catch (const engine::Error&) {
        return false;
    }
}

// Returns the name of a file for settings: relative if it is below the folder, otherwise absolute.
std::string nameIn(const fs::path& directory, const fs::path& file) {
    const fs::path folder = fs::weakly_canonical(directory.empty() ? fs::path(".") : directory);
    const fs::path absolute =
        fs::weakly_canonical(fs::absolute(file).parent_path()) / file.filename();
    const fs::path relative = absolute.lexically_relative(folder);
    const bool below = !relative.empty() && *relative.begin() != "..";
    std::string name = (below ? relative : absolute).generic_string();
    if (!hair::groom::isUtf8(name)) throw engine::Error(file.string(), "its name is not UTF-8");
    return name;
}

void addMesh(hair::RenderSettings& render, const fs::path& file, const std::string& name) {
    const hair::Field& field = hair::fieldAt(render, &render.meshes);
    const std::size_t most = std::get<hair::List>(field.kind).maximum_count;
    if (render.meshes.size() >= most)
        throw engine::Error(
            file.string(), "the scene has " + std::to_string(most) + " meshes already, the limit");
    hair::groom::importMesh(file);
    render.meshes.push_back({.file = name});
}

enum class Holds { strands, triangles };

Holds inObj(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    bool lines = false;
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == std::string::npos || first + 1 >= line.size()) continue;
        if (line[first + 1] != ' ' && line[first + 1] != '\t') continue;  // "vn", "fo"
        if (line[first] == 'f') return Holds::triangles;
        lines = lines || line[first] == 'l';
    }
    return lines ? Holds::strands : Holds::triangles;
}

Holds inPly(const fs::path& path) {
    constexpr std::streamsize kLongestHeader = 1 << 20;  // bytes
    std::string head(kLongestHeader, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), kLongestHeader);
    head.resize(static_cast<std::size_t>(file.gcount()));
    const hair::groom::PlyHeader header = hair::groom::readPlyHeader(head);
    for (const char* name : {"strand", "polyline", "line"})
        if (header.find(name)) return Holds::strands;
    const hair::groom::PlyElement* const faces = header.find("face");
    const bool has_faces = faces && faces->count > 0;
    return header.find("edge") && !has_faces ? Holds::strands : Holds::triangles;
}

Holds inGltf(const fs::path& path) {
    constexpr int kFirstOfTriangles = 4;  // glTF 2.0, mesh.primitive.mode: 0 to 3 points and lines
    const std::string file = engine::readFile(path);
    const scene::Json document = scene::Json::parse(
        hair::groom::isGlb(file) ? hair::groom::glbChunks(file).json : std::string_view(file),
        nullptr, false);
    bool lines = false;
    for (const scene::Json& mesh : document.value("meshes", scene::Json::array()))
        for (const scene::Json& primitive : mesh.value("primitives", scene::Json::array())) {
            if (primitive.value("mode", kFirstOfTriangles) >= kFirstOfTriangles)
                return Holds::triangles;
            lines = true;
        }
    return lines ? Holds::strands : Holds::triangles;
}

// USD with curves counts as strands, and so does a file that cannot be read.
Holds inUsd(const fs::path& file) {
    try {
        hair::groom::importStrands(file, 0);
        return Holds::strands;
    } catch (const engine::Error&) {
    }
    try {
        hair::groom::importMesh(file);
        return Holds::triangles;
    } catch (const engine::Error&) {
        return Holds::strands;
    }
}

// Returns the contents of a file in a format for both strands and meshes: OBJ, PLY, glTF, USD.
// Triangles if the file has any: an OBJ with an `f` line, a glTF with a primitive of triangles (or
// without a stated mode), a PLY with faces and without an element of strands. (Faces with two
// corners, as assimp writes lines, count as faces.) Reads an OBJ up to the first face, a PLY's
// header, a glTF's JSON, but all of a USD file. Other unreadable files count as triangles, because
// their import reports the error.
Holds strandsOrTriangles(const fs::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    try {
        if (extension == ".obj") return inObj(file);
        if (extension == ".ply") return inPly(file);
        if (extension.starts_with(".usd")) return inUsd(file);
        return inGltf(file);
    } catch (const engine::Error&) {
        return Holds::triangles;
    } catch (const scene::Json::exception&) {  // JSON, but not glTF
        return Holds::triangles;
    }
}

constexpr std::uint32_t kMostAsGuides = 1000;  // up to this many strands, all become guides
constexpr std::uint32_t kGuides = 300;  // guides of a dense groom: docs/grooms.md
constexpr std::uint32_t kRootsAsked = 1000;  // approximate number of roots to compare with the mesh
constexpr double kOnSurface = 0.01;  // m

bool growOn(
    const hair::groom::Mesh& mesh, const hair::groom::StrandSet& strands, double metres_per_unit) {
    const hair::groom::NearestSurface nearest(mesh.positions, mesh.triangles);
    const std::uint32_t step = std::max(strands.strandCount() / kRootsAsked, 1u);
    std::vector<float> distances;
    for (std::uint32_t i = 0; i < strands.strandCount(); i += step) {
        const glm::dvec3 root(strands.points[strands.first(i)]);
        distances.push_back(static_cast<float>(nearest(root * metres_per_unit).distance));
    }
    return hair::groom::summaryOf(distances).quartile3 <= kOnSurface;
}

// Removes bodies that move with a head that is gone.
void removeBodiesOfHead(hair::SimulationSettings& simulation) {
    std::erase_if(simulation.colliders, [](const hair::Collider& collider) {
        return collider.follows == hair::Follows::head;
    });
    std::erase_if(simulation.distance_fields, [](const hair::DistanceFieldSettings& field) {
        return field.follows == hair::Follows::head || field.mesh.empty();
    });
}

// Returns settings with the hair of a file, without the style, placement and pulls of the previous
// hair.
//   - A unit that the file does not state is guessed as in `groom info`.
//   - With more than 1,000 strands, 300 become guides, and all strands are drawn, each moved by
//     three guides.
//   - The mesh stays if the roots are on it (three quarters of them within 1 cm). Otherwise it is
//     removed with the bodies that follow it, and the strands float.
// Settings call the file `name`; other names in them are relative to `directory`.
hair::Settings withGroom(
    hair::Settings settings, const fs::path& directory, const fs::path& file,
    const std::string& name) {
    const hair::groom::StrandSet strands = hair::groom::importStrands(file);
    const double metres_per_unit = strands.metres_per_unit.value_or(
        hair::groom::inspect(strands, nullptr, {}).metres_per_unit);

    hair::GroomSettings& groom = settings.groom;
    const std::string head = groom.file.empty() ? groom.grow.mesh : groom.mesh;
    const bool has_head =
        !head.empty() &&
        growOn(hair::groom::importMesh(directory / head), strands, metres_per_unit);
    groom.file = name;
    groom.mesh = has_head ? head : "";
    groom.placement = {};
    if (!strands.metres_per_unit) groom.placement.scale = static_cast<float>(metres_per_unit);
    groom.vertices = 0;
    groom.style = {};
    if (!has_head) removeBodiesOfHead(settings.simulation);
    settings.simulation.pulls.clear();

    const bool dense = strands.strandCount() > kMostAsGuides;
    groom.guides = dense ? kGuides : 0;
    if (dense) settings.strands.source = hair::StrandSource::groom;
    if (!strands.widths.known()) settings.strands.width = hair::WidthSource::scene;
    return settings;
}

// ---- Recordings ---------------------------------------------------------------------------------

constexpr double kUsualFrame = 1.0 / 60.0;  // s, for a scene whose frames take no time

// "0012"; larger numbers have more digits.
std::string fourDigits(std::uint32_t number) {
    std::string digits = std::to_string(number);
    return std::string(4 - std::min<std::size_t>(digits.size(), 4), '0') + digits;
}

}  // namespace

// ---- Settings as arguments of the command line --------------------------------------------------

std::string caseArguments(const scene::Scene& scene, const hair::Settings& settings) {
    const scene::Json wanted = scene::writeSettings(settings);
    std::vector<Argument> arguments;
    try {
        arguments = axisArguments(scene, settings);
    } catch (const engine::Error& error) {
        throw engine::Error(scene.path.string(), error.what());
    }
    addChanges(scene::writeSettings(scene.settings), wanted, "", scene.axes, arguments);
    shorten(arguments, settings);
    check(scene, arguments, wanted);
    std::string text;
    for (const Argument& argument : arguments)
        text += (text.empty() ? "" : " ") + std::string(argument.in_name ? "-a " : "--set ") +
                quoted(argument.pointer + '=' + valueText(argument.value));
    return text;
}

// ---- Readable JSON ------------------------------------------------------------------------------

std::string readableJson(const scene::Json& document) {
    const bool lines = document.is_structured() && !document.empty();
    return (lines ? onLines(document, 0) : document.dump()) + '\n';
}

// ---- Scenes, opened and saved -------------------------------------------------------------------

SceneFile openScene(const fs::path& path, scene::Outside outside) {
    const scene::Scene scene = scene::loadScene(path, outside);
    return {scene.path, scene.directory, scene.name, scene.settings};
}

hair::Settings movedFiles(hair::Settings settings, const fs::path& from, const fs::path& to) {
    const fs::path old_folder = folderOf(from);
    const fs::path folder = folderOf(to);
    if (old_folder == folder) return settings;
    scene::forEachFileName(settings, [&](const std::string&, std::string& name) {
        if (fs::path(name).is_absolute()) return;
        const fs::path old = old_folder / name;
        // A name that is itself a link stays a link, because its target may change.
        const fs::path file = folderOf(old.parent_path()) / old.filename();
        name = file.lexically_relative(folder).generic_string();
    });
    return settings;
}

std::string sceneText(const hair::Settings& settings, const fs::path& from, const fs::path& to) {
    scene::Json document = scene::Json::object();
    std::error_code error;
    if (fs::exists(to / kSchema, error)) document["$schema"] = kSchema;
    document.update(scene::changedFields(movedFiles(settings, from, to)));
    return readableJson(document);
}

void saveScene(const hair::Settings& settings, const fs::path& from, const fs::path& file) {
    engine::writeFileAtomically(file, sceneText(settings, from, file.parent_path()));
}

// ---- Files dropped on the window ----------------------------------------------------------------

Dropped whatIs(const fs::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return Dropped::unknown;
    if (extension == ".json") return Dropped::scene;
    if (extension == ".png") return hasScene(file) ? Dropped::scene : Dropped::unknown;
    if (extension == ".exr" || extension == ".hdr") return Dropped::environment;
    const bool groom = isGroom(file);
    if (groom && isMesh(extension))
        return strandsOrTriangles(file) == Holds::strands ? Dropped::groom : Dropped::mesh;
    return groom ? Dropped::groom : isMesh(extension) ? Dropped::mesh : Dropped::unknown;
}

hair::Settings
withDropped(hair::Settings settings, const fs::path& directory, const fs::path& file) {
    const Dropped kind = whatIs(file);
    if (kind == Dropped::unknown || kind == Dropped::scene) {
        std::error_code error;
        throw engine::Error(
            file.string(), fs::is_regular_file(file, error)
                               ? "is not a groom, mesh or environment (.exr, .hdr)"
                               : "no such file");
    }
    const std::string name = nameIn(directory, file);
    if (kind == Dropped::groom) return withGroom(std::move(settings), directory, file, name);
    if (kind == Dropped::mesh) {
        addMesh(settings.render, file, name);
    } else {
        engine::readFloatImage(file);
        settings.render.environment = name;
    }
    return settings;
}

// ---- Recordings ---------------------------------------------------------------------------------

void Recorder::start(const fs::path& path) {
    engine::checkWritable(path);
    path_ = path;
    film_.reset();
    last_.reset();
}

void Recorder::stop() {
    path_.clear();
    film_.reset();
}

void Recorder::frame(const Shown& shown) {
    if (!records() || last_ == shown.frame || !shown.isThere()) return;
    try {
        const bool is_first = !film_;
        if (is_first) {
            film_.emplace(path_, shown.width, shown.height);
            width_ = shown.width;
            height_ = shown.height;
        }
        if (shown.width != width_ || shown.height != height_)
            throw engine::Error(
                path_.string(), "the recording ends, for the picture's size changed");
        const double seconds = double{shown.settings.run.frame_time};
        film_->add(
            shown.picture, seconds > 0.0 ? seconds : kUsualFrame, scene::kSceneKeyword,
            is_first ? sceneText(shown.settings, shown.directory, path_.parent_path()) : "");
    } catch (...) {
        stop();
        throw;
    }
    last_ = shown.frame;
}

std::string Recorder::message() const { return records() ? "recording " + figures() : ""; }

std::string Recorder::summary() const { return records() ? "recorded " + figures() : ""; }

std::string Recorder::figures() const {
    const std::uint32_t frames = film_ ? film_->pictures() : 0;
    return std::to_string(frames) + (frames == 1 ? " frame" : " frames") + " to " + path_.string() +
           ", " + report::sizeText(film_ ? film_->size() : 0);
}

// ---- Screenshots --------------------------------------------------------------------------------

void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene) {
    std::string file;
    try {
        file = engine::withPngText(
            engine::encodePng(width, height, rgba), scene::kSceneKeyword, scene);
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
    engine::writeFileAtomically(path, file);
}

std::filesystem::path freeName(
    const std::filesystem::path& folder, const std::string& stem, const std::string& extension) {
    for (std::uint32_t number = 1;; ++number) {
        std::filesystem::path path = folder / (stem + '-' + fourDigits(number) + extension);
        std::error_code error;
        if (std::filesystem::symlink_status(path, error).type() ==
            std::filesystem::file_type::not_found)
            return path;
        // In an unreadable folder, no free name can be found. Writing will report the error.
        if (error) return path;
    }
}

}  // namespace benchmarks::viewer
