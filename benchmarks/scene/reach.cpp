#include "benchmarks/scene/reach.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>

#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/program_files.h"
#include "hair/fields.h"
#include "hair/groom/named_files.h"
#include "hair/settings.h"

namespace benchmarks::scene {
namespace {

namespace fs = std::filesystem;

// ---- Folders ------------------------------------------------------------------------------------

using hair::groom::isBelow;
using hair::groom::placeOf;

// Ignores the mark in folders that anyone may write to, like /tmp.
bool isMarked(const fs::path& folder) {
    std::error_code error;
    const fs::perms permissions = fs::status(folder, error).permissions();
    return !error && (permissions & fs::perms::others_write) == fs::perms::none &&
           fs::exists(folder / "scene.schema.json", error);
}

fs::path folderOfScenes(const fs::path& opened) {
    const fs::path own = placeOf(opened.has_parent_path() ? opened.parent_path() : fs::path("."));
    for (fs::path folder = own;; folder = folder.parent_path()) {
        if (isMarked(folder)) return folder;
        if (folder == folder.parent_path()) return own;
    }
}

}  // namespace

// ---- The program's own scenes -------------------------------------------------------------------

fs::path sceneNamed(const fs::path& name) {
    std::error_code error;
    const bool is_file = fs::exists(name, error) && !fs::is_directory(name, error);
    if (is_file || name.empty() || name.is_absolute()) return name;
    fs::path below = name.lexically_normal();
    if (*below.begin() == "scenes") below = below.lexically_relative("scenes");
    if (*below.begin() == "..") return name;
    for (const char* extension : {"", ".json"}) {
        const fs::path shipped = engine::programFile("scenes") / (below.string() + extension);
        if (fs::is_regular_file(shipped, error)) return shipped;
    }
    return name;
}

std::vector<std::string> shippedScenes() {
    const fs::path folder = engine::programFile("scenes");
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator each(folder, error), end; !error && each != end;
         each.increment(error)) {
        const std::string name = each->path().lexically_relative(folder).string();
        if (name.ends_with(".json") && !name.ends_with(".schema.json") &&
            !name.starts_with("assets/"))
            names.push_back(name.substr(0, name.size() - std::string_view(".json").size()));
    }
    std::ranges::sort(names);
    return names;
}

// ---- Reach --------------------------------------------------------------------------------------

Reach::Reach(const fs::path& opened, Outside outside) {
    if (outside == Outside::refused)
        folders_ = {folderOfScenes(opened), engine::programFile("scenes")};
}

void Reach::check(const fs::path& file) const {
    if (folders_.empty()) return;
    const fs::path place = placeOf(file);
    const auto holds = [&](const fs::path& folder) { return isBelow(place, folder); };
    if (std::ranges::none_of(folders_, holds))
        throw engine::Error(
            file.string(), "is outside " + folders_.front().string() +
                               ", the scene's folder; --allow-outside permits it");
}

void Reach::check(const fs::path& file, const fs::path& owner) const {
    if (!isBelow(placeOf(file), placeOf(owner).parent_path())) check(file);
}

std::vector<fs::path> Reach::folders(const fs::path& owner) const {
    std::vector<fs::path> all = folders_;
    if (!all.empty()) all.push_back(placeOf(owner).parent_path());
    return all;
}

namespace {

// ---- Names of files -----------------------------------------------------------------------------

using NameVisitor = std::function<void(const std::string& pointer, const std::string& name)>;

// "groom/file" -> "groom", leaving "file" in `rest`; leaves nothing after the last token.
std::string_view takeToken(std::string_view& rest) {
    const std::size_t end = std::min(rest.find('/'), rest.size());
    const std::string_view token = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return token;
}

// Visits the file names in a JSON value of the settings, or of their member at `rest`, such as
// "groom/file". `pointer` is the pointer of the settings.
void visitNames(
    const Json& value, std::string_view rest, hair::SettingsView settings,
    const std::string& pointer, const NameVisitor& visit);

void visitNames(
    const hair::Place&, const Json&, std::string_view, hair::SettingsView, const std::string&,
    const NameVisitor&) {}

void visitNames(
    const hair::FileName&, const Json& value, std::string_view, hair::SettingsView,
    const std::string& pointer, const NameVisitor& visit) {
    if (value.is_string()) visit(pointer, value.get_ref<const std::string&>());
}

void visitNames(
    const hair::ChoiceOrFile&, const Json& value, std::string_view, hair::SettingsView,
    const std::string& pointer, const NameVisitor& visit) {
    if (value.is_string() &&
        value.get_ref<const std::string&>().ends_with(hair::ChoiceOrFile::kExtension))
        visit(pointer, value.get_ref<const std::string&>());
}

void visitNames(
    const hair::Group& row, const Json& value, std::string_view rest, hair::SettingsView settings,
    const std::string& pointer, const NameVisitor& visit) {
    visitNames(value, rest, row.in(settings), pointer, visit);
}

void visitNames(
    const hair::List& row, const Json& value, std::string_view rest, hair::SettingsView,
    const std::string& pointer, const NameVisitor& visit) {
    if (!rest.empty()) {
        const std::string element = pointer + '/' + std::string(takeToken(rest));
        return visitNames(value, rest, row.newElement(), element, visit);
    }
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
        visitNames(value[i], "", row.newElement(), pointer + '/' + std::to_string(i), visit);
}

void visitNames(
    const Json& value, std::string_view rest, hair::SettingsView settings,
    const std::string& pointer, const NameVisitor& visit) {
    const std::string_view token = takeToken(rest);
    if (token.empty() && !value.is_object()) return;
    for (const hair::Field& field : settings.fields()) {
        if (token.empty() ? !value.contains(field.name) : token != field.name) continue;
        const Json& member = token.empty() ? value.at(field.name) : value;
        std::visit(
            [&](const auto& row) {
                visitNames(row, member, rest, settings, pointer + '/' + field.name, visit);
            },
            field.kind);
    }
}

}  // namespace

void checkNamedFiles(
    const Json& value, const std::string& pointer, const fs::path& directory, const Reach& reach) {
    const hair::Settings defaults;
    visitNames(
        value, pointer.empty() ? "" : std::string_view(pointer).substr(1), defaults, "",
        [&](const std::string& place, const std::string& name) {
            if (name.empty()) return;
            try {
                reach.check(directory / name);
            } catch (const engine::Error& error) {
                throw engine::Error(place, error.what());
            }
        });
}

}  // namespace benchmarks::scene
