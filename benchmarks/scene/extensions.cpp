#include "benchmarks/scene/extensions.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/shaders.h"
#include "hair/fields.h"
#include "hair/groom/named_files.h"

namespace benchmarks::scene {

// ---- Reach --------------------------------------------------------------------------------------

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

fs::path sceneNamed(const fs::path& name, const fs::path& folder) {
    const fs::path own = folder / name;
    std::error_code error;
    const bool is_file = fs::exists(own, error) && !fs::is_directory(own, error);
    if (is_file || name.empty() || name.is_absolute()) return own;
    fs::path below = name.lexically_normal();
    if (*below.begin() == "scenes") below = below.lexically_relative("scenes");
    if (*below.begin() == "..") return own;
    for (const char* extension : {"", ".json"}) {
        const fs::path shipped = engine::programFile("scenes") / (below.string() + extension);
        if (fs::is_regular_file(shipped, error)) return shipped;
    }
    return own;
}

std::vector<std::string> shippedScenes() {
    const fs::path folder = engine::programFile("scenes");
    std::vector<std::string> names;
    std::error_code error;
    for (fs::recursive_directory_iterator each(folder, error), end; !error && each != end;
         each.increment(error)) {
        const std::string name = each->path().lexically_relative(folder).generic_string();
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

bool isAtOrBelow(std::string_view pointer, std::string_view top) {
    return pointer.starts_with(top) && (pointer.size() == top.size() || pointer[top.size()] == '/');
}

// Visits the names at a JSON pointer or below it.
class NameWalk {
public:
    NameWalk(std::string top, const FileNameVisitor& visit) : top_(std::move(top)), visit_(visit) {}

    // `pointer`: of the settings.
    void walk(hair::SettingsRef settings, const std::string& pointer) const {
        for (const hair::Field& field : settings.fields()) {
            const std::string place = pointer + '/' + field.name;
            if (isAtOrBelow(place, top_) || isAtOrBelow(top_, place))
                std::visit([&](const auto& row) { visit(row, settings, place); }, field.kind);
        }
    }

private:
    void visit(const hair::Place&, hair::SettingsRef, const std::string&) const {}

    void
    visit(const hair::FileName& row, hair::SettingsRef settings, const std::string& pointer) const {
        if (std::string& name = row.in(settings); !name.empty()) visit_(pointer, name);
    }

    void visit(
        const hair::ChoiceOrFile& row, hair::SettingsRef settings,
        const std::string& pointer) const {
        visit(hair::FileName{{row.file}}, settings, pointer);
    }

    void
    visit(const hair::Group& row, hair::SettingsRef settings, const std::string& pointer) const {
        walk(row.in(settings), pointer);
    }

    void
    visit(const hair::List& row, hair::SettingsRef settings, const std::string& pointer) const {
        for (std::size_t i = 0; i < row.size(settings); ++i)
            walk(row.at(settings, i), pointer + '/' + std::to_string(i));
    }

    std::string top_;
    const FileNameVisitor& visit_;
};

}  // namespace

void forEachFileName(hair::Settings& settings, const FileNameVisitor& visit) {
    NameWalk("", visit).walk(settings, "");
}

void checkNamedFiles(
    hair::Settings settings, const std::string& pointer, const fs::path& directory,
    const Reach& reach) {
    const FileNameVisitor check = [&](const std::string& place, const std::string& name) {
        try {
            reach.check(directory / name);
        } catch (const engine::Error& error) {
            throw engine::Error(place, error.what());
        }
    };
    NameWalk(pointer, check).walk(settings, "");
}

// ---- Extensions ---------------------------------------------------------------------------------

namespace {

// The file and parameters of an extension field in the settings.
template <class Settings, class Parameters>
struct Named {
    const std::string& file;
    Parameters& parameters;
};

template <class Settings>
auto named(Settings& settings, hair::ExtensionKind kind) {
    using Parameters = std::remove_reference_t<decltype((settings.shading.model_parameters))>;
    using Of = Named<Settings, Parameters>;
    switch (kind) {
    case hair::ExtensionKind::shading:
        return Of{settings.shading.model_file, settings.shading.model_parameters};
    case hair::ExtensionKind::offset:
        return Of{settings.strands.offset_function, settings.strands.offset_parameters};
    case hair::ExtensionKind::force:
        return Of{settings.simulation.force, settings.simulation.force_parameters};
    case hair::ExtensionKind::solver:
        return Of{settings.simulation.solver_file, settings.simulation.solver_parameters};
    case hair::ExtensionKind::curve:
        break;
    }
    return Of{settings.strands.curve_file, settings.strands.curve_parameters};
}

std::vector<std::string> namesOf(const hair::Extension& extension) {
    std::vector<std::string> names;
    for (const hair::ExtensionParameter& parameter : extension.parameters)
        names.push_back(parameter.name);
    return names;
}

void checkValue(
    const hair::ExtensionValue& value, const hair::ExtensionParameter& parameter,
    const std::string& pointer) {
    if (value.is_vector != parameter.is_vector)
        throw engine::Error(
            pointer, parameter.is_vector ? "expected an array of 3 numbers, found a number"
                                         : "expected a number, found an array");
    for (int i = 0; i < (parameter.is_vector ? 3 : 1); ++i)
        checkInRange(
            parameter.is_vector ? pointer + '/' + std::to_string(i) : pointer,
            double{value.value[i]}, {parameter.minimum, parameter.maximum, parameter.unit.c_str()});
}

// Returns all parameters of the file in its order, with defaults for those that are not set.
std::vector<hair::ExtensionValue> completed(
    const std::vector<hair::ExtensionValue>& set, const hair::Extension& extension,
    const std::string& pointer) {
    std::vector<hair::ExtensionValue> all;
    for (const hair::ExtensionParameter& parameter : extension.parameters) {
        const auto found = std::ranges::find(set, parameter.name, &hair::ExtensionValue::name);
        if (found == set.end()) {
            all.push_back({parameter.name, parameter.is_vector, parameter.original});
            continue;
        }
        checkValue(*found, parameter, pointer + '/' + parameter.name);
        all.push_back(*found);
    }
    return all;
}

// A parameter that the host reads too.
struct HostParameter {
    hair::ExtensionKind kind;
    const char* name;
    double least;  // of its range
    bool required;
    const char* meaning;
};

constexpr HostParameter kHostParameters[]{
    {hair::ExtensionKind::offset, "reach", 0.0, true,
     "a number of at least 0 m that no offset exceeds"},
    {hair::ExtensionKind::solver, hair::kLongestSubstep, 1e-5, false,
     "a number of at least 1e-05 s, the longest substep of /simulation/substeps 0"}};

void checkHostParameters(const hair::Extension& extension) {
    for (const HostParameter& each : kHostParameters) {
        if (extension.kind != each.kind) continue;
        const auto found =
            std::ranges::find(extension.parameters, each.name, &hair::ExtensionParameter::name);
        if (found == extension.parameters.end() && !each.required) continue;
        if (found == extension.parameters.end() || found->is_vector || found->minimum < each.least)
            throw engine::Error(
                extension.shader->name,
                std::string(each.required ? "must declare a parameter '" : "has a parameter '") +
                    each.name + "'" + (each.required ? ": " : " that must be ") + each.meaning);
    }
}

void loadOne(
    const std::string& file, hair::ExtensionParameters& parameters, const ExtensionField& field,
    const std::filesystem::path& directory, const Reach& reach, UnknownParameters unknown) {
    parameters.file = nullptr;
    if (file.empty()) {
        if (!parameters.values.empty() && unknown == UnknownParameters::refused)
            throw engine::Error(
                field.parameters, std::string("is set, but ") + field.pointer + " names no file");
        parameters.values.clear();
        return;
    }
    const std::filesystem::path path = directory / file;
    try {
        reach.check(path);
        parameters.file = std::make_shared<const hair::Extension>(hair::parseExtension(
            field.kind, path.string(), engine::readFile(path, hair::kLargestExtension)));
        checkHostParameters(*parameters.file);
    } catch (const engine::Error& error) {
        throw engine::Error(field.pointer, error.what());
    }
    const std::vector<std::string> known = namesOf(*parameters.file);
    if (unknown == UnknownParameters::refused)
        for (const hair::ExtensionValue& value : parameters.values)
            if (std::ranges::find(known, value.name) == known.end())
                throw engine::Error(
                    std::string(field.parameters) + '/' + escapedToken(value.name),
                    known.empty() ? path.string() + " declares no parameters"
                                  : unknownName("unknown key", value.name, known));
    parameters.values = completed(parameters.values, *parameters.file, field.parameters);
}

// Parameters of files that are linked into one shader must differ in their names: to the linker,
// equal names are one constant.
void checkNames(const hair::Settings& settings) {
    using hair::ExtensionKind;
    std::map<std::string, const char*> known;  // by parameter
    for (const ExtensionField& field : kExtensionFields) {
        if (field.kind == ExtensionKind::force || field.kind == ExtensionKind::solver) continue;
        for (const hair::ExtensionValue& value : named(settings, field.kind).parameters.values) {
            const auto [other, is_new] = known.emplace(value.name, field.pointer);
            if (!is_new)
                throw engine::Error(
                    field.pointer, "declares '" + value.name + "' as the file of " + other->second +
                                       " does: rename one");
        }
    }
}

// Returns one entry point of each stage that calls functions of the extension. Stages differ in
// what they offer: only a fragment has a place in the picture, for example.
std::vector<std::string> entryPointsOf(const engine::ShaderExtension& extension) {
    std::vector<std::string> paths;
    std::set<std::string> kinds;
    for (const std::string_view path : engine::shaderPaths()) {
        const std::string kind =
            std::filesystem::path(engine::shaderFile(path)).extension().string();
        if (!kinds.contains(kind) &&
            engine::shaderSources(engine::shaderCode(path)).contains(extension.interface)) {
            kinds.insert(kind);
            paths.emplace_back(path);
        }
    }
    // The stages with the best known inputs first: they tell that these are not permitted, and
    // others only that they do not know them.
    std::ranges::stable_partition(paths, [](const std::string& path) {
        const std::string_view file = engine::shaderFile(path);
        return file.ends_with(".vert") || file.ends_with(".frag");
    });
    return paths;
}

}  // namespace

hair::ExtensionParameters& parametersOf(hair::Settings& settings, hair::ExtensionKind kind) {
    return named(settings, kind).parameters;
}

const hair::ExtensionParameters&
parametersOf(const hair::Settings& settings, hair::ExtensionKind kind) {
    return named(settings, kind).parameters;
}

void loadExtensions(
    hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach,
    UnknownParameters unknown) {
    for (const ExtensionField& field : kExtensionFields) {
        const auto [file, parameters] = named(settings, field.kind);
        loadOne(file, parameters, field, directory, reach, unknown);
    }
    checkNames(settings);
}

hair::Settings
withExtensions(const hair::Settings& settings, const std::filesystem::path& directory) {
    hair::Settings loaded = settings;
    loadExtensions(loaded, directory);
    return loaded;
}

void rereadExtensions(hair::Settings& settings, const std::filesystem::path& directory) {
    hair::Settings read = settings;
    try {
        loadExtensions(read, directory, {}, UnknownParameters::dropped);
        settings = std::move(read);
    } catch (const engine::Error&) {
    }
}

void checkExtensions(const hair::Settings& settings) {
    const engine::ShaderLibrary library;
    engine::ShaderExtensions all;
    for (const ExtensionField& field : kExtensionFields) {
        const auto [file, parameters] = named(settings, field.kind);
        if (!parameters.file) continue;
        try {
            const engine::ShaderExtensions own = hair::shaderExtensions(parameters);
            const std::vector<std::string> paths = entryPointsOf(*own.front());
            for (const std::string& path : paths) library.extended(path, own);
            // Then with the files before, which may share its stages.
            all.insert(all.begin(), own.front());
            for (const std::string& path : paths) library.extended(path, all);
        } catch (const engine::Error& error) {
            throw engine::Error(field.pointer, error.what());
        }
    }
}

std::vector<NamedExtension> namedExtensions(const hair::Settings& settings) {
    std::vector<NamedExtension> all;
    for (const ExtensionField& field : kExtensionFields) {
        const auto [file, parameters] = named(settings, field.kind);
        if (parameters.file) all.push_back({field.pointer, file, parameters.file->text});
    }
    return all;
}

}  // namespace benchmarks::scene
