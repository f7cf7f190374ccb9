#include "benchmarks/scene/extensions.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/shaders.h"
#include "hair/fields.h"

namespace benchmarks::scene {
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
        break;
    }
    return Of{settings.simulation.force, settings.simulation.force_parameters};
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

// The host and the shaders must know how far an offset can move strands.
void checkReach(const hair::Extension& extension) {
    if (extension.kind != hair::ExtensionKind::offset) return;
    const auto reach =
        std::ranges::find(extension.parameters, "reach", &hair::ExtensionParameter::name);
    if (reach == extension.parameters.end() || reach->is_vector || reach->minimum < 0.0)
        throw engine::Error(
            extension.shader->name,
            "must declare a parameter 'reach': a number of at least 0 m that no offset exceeds");
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
        checkReach(*parameters.file);
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

// Returns one entry point of each stage that calls functions of the extension. Stages differ in
// what they offer: only a fragment has a place in the picture, for example.
std::vector<std::string> entryPointsOf(const engine::ShaderExtension& extension) {
    std::vector<std::string> paths;
    std::set<std::string> kinds;
    for (const std::string_view path : engine::shaderPaths()) {
        const std::string kind = std::filesystem::path(path).extension().string();
        if (!kinds.contains(kind) &&
            engine::shaderSources(engine::shaderCode(path)).contains(extension.interface)) {
            kinds.insert(kind);
            paths.emplace_back(path);
        }
    }
    return paths;
}

}  // namespace

void loadExtensions(
    hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach,
    UnknownParameters unknown) {
    for (const ExtensionField& field : kExtensionFields) {
        const auto [file, parameters] = named(settings, field.kind);
        loadOne(file, parameters, field, directory, reach, unknown);
    }
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
    for (const ExtensionField& field : kExtensionFields) {
        const auto [file, parameters] = named(settings, field.kind);
        if (!parameters.file) continue;
        try {
            const engine::ShaderLibrary library;
            for (const std::string& path : entryPointsOf(*parameters.file->shader))
                library.extended(path, hair::shaderExtensions(parameters));
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
