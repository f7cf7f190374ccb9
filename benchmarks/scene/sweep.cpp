#include "benchmarks/scene/sweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/assets.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/schema.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::scene {
namespace {

// ---- Suites -------------------------------------------------------------------------------------

// Returns null if the file is missing or not a suite. loadScene() reports errors in it.
Json suiteDocument(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path)) return nullptr;
    const std::string text = engine::readFile(path, kLargestSceneFile);
    // Only a file with this word can be a suite, so other scenes are not parsed twice.
    if (text.find("\"suite\"") == std::string::npos) return nullptr;
    Json document = parseJson(text, path.string());
    if (!document.is_object() || !document.contains("suite")) return nullptr;
    return document;
}

void checkMembers(const Json& document) {
    for (const auto& [key, value] : document.items()) {
        if (key != "$schema" && key != "description" && key != "suite")
            throw engine::Error('/' + key, "unknown key; known: $schema, description, suite");
        if (key != "suite" && !value.is_string())
            throw engine::Error('/' + key, "expected a string, found " + described(value));
    }
    const Json& suite = document["suite"];
    if (!suite.is_array() || suite.empty())
        throw engine::Error("/suite", "expected a list of scene files, found " + described(suite));
    for (const Json& file : suite)
        if (!file.is_string())
            throw engine::Error(
                "/suite", "expected names of scene files, found " + described(file));
}

}  // namespace

bool isSuite(const std::filesystem::path& path) { return !suiteDocument(path).is_null(); }

std::vector<Scene> loadScenes(const std::filesystem::path& path, Outside outside) {
    const Reach reach(path, outside);
    const Json document = suiteDocument(path);
    std::vector<Scene> scenes;
    if (document.is_null()) {
        scenes.push_back(loadScene(path, reach));
        return scenes;
    }
    try {
        checkMembers(document);
        for (const Json& file : document["suite"]) {
            const std::filesystem::path member =
                sceneNamed(file.get<std::string>(), path.parent_path());
            reach.check(member);
            if (isSuite(member))
                throw engine::Error("/suite", member.string() + " is a suite itself");
            scenes.push_back(loadScene(member, reach));
            const std::string& name = scenes.back().name;
            if (std::ranges::count(scenes, name, &Scene::name) > 1)
                throw engine::Error("/suite", "two scenes have the name '" + name + '\'');
        }
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
    return scenes;
}

namespace {

// ---- Cases of a sweep ---------------------------------------------------------------------------

// Returns the pointers that change with the axis.
std::vector<std::string> fields(const Axis& axis) {
    std::vector<std::string> pointers{axis.pointer};
    for (const Axis& other : axis.tied) pointers.push_back(other.pointer);
    return pointers;
}

std::vector<Axis> withOverrides(const Scene& scene, std::span<const Axis> overrides) {
    std::vector<Axis> axes = scene.axes;
    for (const Axis& override_axis : overrides) {
        Axis axis;
        try {
            axis = checkedAxis(override_axis, scene.settings);
        } catch (const engine::Error& error) {
            throw engine::Error("-a", error.what());
        }
        const auto place = std::ranges::find_if(
            axes, [&](const Axis& each) { return std::ranges::count(fields(each), axis.pointer); });
        if (place == axes.end())
            axes.push_back(std::move(axis));
        else if (place->tied.empty())
            *place = std::move(axis);
        else
            throw engine::Error(
                "-a", axis.pointer + ": the scene's sweep changes it together with other fields");
    }
    return axes;
}

// Requires that the sweep's pointers are distinct and none lies inside another.
void requireIndependent(const std::vector<std::string>& pointers) {
    for (const std::string& outer : pointers) {
        if (std::ranges::count(pointers, outer) > 1) throw engine::Error(outer, "is swept twice");
        for (const std::string& inner : pointers)
            if (inner.starts_with(outer + '/'))
                throw engine::Error(inner, "is inside the axis " + outer);
    }
}

std::size_t caseCount(const std::vector<Axis>& axes) {
    std::size_t count = 1;
    for (const Axis& axis : axes) {
        count *= axis.values.size();
        if (count > kMaximumCases)
            throw engine::Error(
                "/sweep", "has more than " + std::to_string(kMaximumCases) + " cases");
    }
    return count;
}

// Returns the index-th combination. The axes count like digits, the last one fastest.
std::vector<AxisValue> combination(const std::vector<Axis>& axes, std::size_t index) {
    std::vector<std::size_t> digits(axes.size());
    for (std::size_t i = axes.size(); i-- > 0;) {
        digits[i] = index % axes[i].values.size();
        index /= axes[i].values.size();
    }
    std::vector<AxisValue> values;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        values.push_back({axes[i].pointer, axes[i].values[digits[i]]});
        for (const Axis& other : axes[i].tied)
            values.push_back({other.pointer, other.values[digits[i]]});
    }
    return values;
}

constexpr std::size_t kMostExclusionTests = 10'000'000;  // exclusions times cases; takes seconds

// A scene's exclusions, prepared for lookups by many cases.
class Exclusions {
public:
    explicit Exclusions(std::span<const Exclusion> exclusions) {
        for (const Exclusion& exclusion : exclusions) {
            std::vector<Condition>& conditions = exclusions_.emplace_back();
            for (const Axis& field : exclusion) {
                const auto known = std::ranges::find(pointers_, field.pointer);
                conditions.push_back(
                    {.field = static_cast<std::size_t>(known - pointers_.begin())});
                if (known == pointers_.end()) pointers_.push_back(field.pointer);
                for (const Document& value : field.values)
                    conditions.back().texts.insert(value.text());
            }
        }
    }

    std::size_t count() const { return exclusions_.size(); }

    bool leaveOut(const hair::Settings& settings) const {
        if (exclusions_.empty()) return false;
        std::vector<std::string> texts;
        for (const std::string& pointer : pointers_)
            texts.push_back(Document(valueAt(settings, pointer)).text());
        const auto meets = [&](const Condition& condition) {
            return condition.texts.contains(texts[condition.field]);
        };
        return std::ranges::any_of(exclusions_, [&](const auto& conditions) {
            return std::ranges::all_of(conditions, meets);
        });
    }

private:
    struct Condition {
        std::size_t field;  // in pointers_
        std::unordered_set<std::string> texts;  // of the values that it excludes
    };

    std::vector<std::string> pointers_;
    std::vector<std::vector<Condition>> exclusions_;
};

std::string caseName(
    const std::string& scene, const std::vector<std::string>& labels,
    const std::vector<AxisValue>& values) {
    std::string name = scene;
    for (std::size_t i = 0; i < values.size(); ++i)
        name += '/' + labels[i] + ':' + valueLabel(values[i].value.json());
    return name;
}

// Whether the field or a group that contains it is an axis.
bool isSwept(std::span<const AxisValue> axes, const ExtensionField& field) {
    return std::ranges::any_of(axes, [&](const AxisValue& axis) {
        return (std::string(field.pointer) + '/').starts_with(axis.pointer + '/');
    });
}

// Returns the settings of a case. If a sweep varies the file, each file takes only its own
// parameters.
hair::Settings settingsOf(const Scene& scene, std::span<const AxisValue> axes) {
    hair::Settings settings = scene.settings;
    bool other_files = false;
    for (const ExtensionField& field : kExtensionFields)
        if (isSwept(axes, field)) {
            // The scene's own file may have completed them, but another file has other defaults.
            parametersOf(settings, field.kind) = parametersOf(scene.written, field.kind);
            other_files = true;
        }
    for (const AxisValue& axis : axes) {
        const bool is_parameter =
            std::ranges::any_of(kExtensionFields, [&](const ExtensionField& field) {
                return isSwept(axes, field) && axis.pointer.starts_with(field.parameters);
            });
        setField(
            settings, axis.pointer, axis.value.json(),
            is_parameter ? Objects::replaced : Objects::merged);
    }
    loadExtensions(
        settings, scene.directory, {},
        other_files ? UnknownParameters::dropped : UnknownParameters::refused);
    return settings;
}

// Throws engine::Error if so many copies of the scene's values would take minutes.
void requireQuick(std::size_t count, const Json& document) {
    constexpr std::size_t kMost = 20'000'000;  // copied values, which take seconds
    constexpr std::size_t kSmall = 2'000;  // values; a scene without lists has about 500
    const std::size_t size = valueCount(document);
    if (size > kSmall && count > kMost / size)
        throw engine::Error(
            "/sweep", std::to_string(count) + " cases of a scene with " + std::to_string(size) +
                          " values are too many: the product is at most " + std::to_string(kMost));
}

}  // namespace

std::vector<CaseSpec> expand(const Scene& scene, std::span<const Axis> overrides) {
    const std::vector<Axis> axes = withOverrides(scene, overrides);
    std::vector<std::string> pointers;
    for (const Axis& axis : axes) std::ranges::move(fields(axis), std::back_inserter(pointers));
    const std::vector<std::string> labels = axisLabels(pointers);
    std::vector<CaseSpec> cases;
    std::unordered_set<std::string> names;
    std::string context = scene.path.string();
    try {
        requireIndependent(pointers);
        const std::size_t count = caseCount(axes);
        const Exclusions exclusions(scene.exclusions);
        requireQuick(count, scene.resolved.json());
        if (exclusions.count() > kMostExclusionTests / count)
            throw engine::Error(
                "/sweep/exclude", std::to_string(exclusions.count()) + " conditions for " +
                                      std::to_string(count) +
                                      " cases are too many: the product is at most " +
                                      std::to_string(kMostExclusionTests));
        for (std::size_t i = 0; i < count; ++i) {
            CaseSpec spec;
            spec.axes = combination(axes, i);
            spec.name = caseName(scene.name, labels, spec.axes);
            context = scene.path.string() + (axes.empty() ? "" : ": " + spec.name);
            spec.settings = axes.empty() ? scene.settings : settingsOf(scene, spec.axes);
            if (!axes.empty() && exclusions.leaveOut(spec.settings)) continue;
            checkSettings(spec.settings);
            if (!names.insert(spec.name).second) throw engine::Error("two cases have this name");
            cases.push_back(std::move(spec));
        }
        context = scene.path.string();
        if (cases.empty()) throw engine::Error("/sweep/exclude", "leaves no case");
    } catch (const engine::Error& error) {
        throw engine::Error(context, error.what());
    }
    return cases;
}

namespace {

// ---- Cases that the command line selects --------------------------------------------------------

// Sets the field of "POINTER=VALUE".
void setField(Scene& scene, const std::string& argument) {
    const std::size_t equals = argument.find('=');
    try {
        if (equals == std::string::npos || equals == 0)
            throw engine::Error("expected POINTER=VALUE, as in /strands/density=16");
        const Axis field = checkedAxis(
            {.pointer = argument.substr(0, equals),
             .values = {parseValue(argument.substr(equals + 1))}},
            scene.settings);
        setField(scene, field.pointer, field.values.front().json());
    } catch (const engine::Error& error) {
        throw engine::Error("--set " + argument, error.what());
    }
}

// Throws if one of a case's axes replaces the field of "POINTER=VALUE".
void requireEffect(
    const Scene& scene, const std::string& argument, const std::vector<AxisValue>& axes) {
    const std::string pointer = argument.substr(0, argument.find('='));
    for (const AxisValue& axis : axes)
        if (axis.pointer == pointer)
            throw engine::Error(
                scene.path.string(), "--set " + argument +
                                         ": the sweep varies this field; --axis " + argument +
                                         " replaces its values");
}

// Returns the number as a scene file would have it: 0.02, although settings are floats.
Json decimal(double number) {
    if (!std::isfinite(number)) throw engine::Error("expected a finite number");
    return Json::parse(decimalText(number));
}

}  // namespace

std::vector<CaseSpec> selectCases(
    Scene& scene, const SceneOptions& options, AssetStore* assets,
    std::vector<std::string>* warnings) {
    AssetStore own;
    if (options.frames) setField(scene, "/run/frames", *options.frames);
    if (options.warmup) setField(scene, "/run/warmup", *options.warmup);
    if (options.precision) setField(scene, "/run/precision", decimal(*options.precision));
    if (options.max_time) setField(scene, "/run/max_time", decimal(*options.max_time));
    for (const std::string& set : options.sets) setField(scene, set);
    std::vector<Axis> overrides;
    for (const std::string& axis : options.axes) overrides.push_back(parseAxis(axis));
    std::vector<CaseSpec> cases = expand(scene, overrides);
    for (const std::string& set : options.sets) requireEffect(scene, set, cases.front().axes);

    if (!options.reads_assets) return cases;
    std::set<std::string> checked;
    for (const CaseSpec& each : cases) {
        const hair::GroomSettings& groom = each.settings.groom;
        std::string files;
        for (const std::string& file :
             {groom.file, groom.mesh, groom.grow.mesh, groom.grow.scalp, groom.grow.mask,
              groom.grow.length_map, groom.cache.file, each.settings.strands.offsets,
              each.settings.strands.texture, each.settings.render.environment,
              each.settings.run.reference, each.settings.run.probes.reference})
            files += file + '\n';
        for (const auto& mesh : each.settings.render.meshes) files += '\n' + mesh.file;
        for (const auto& field : each.settings.simulation.distance_fields)
            files += '\n' + field.mesh;
        for (const NamedExtension& extension : namedExtensions(each.settings))
            files += '\n' + extension.file;
        if (const std::string warning = stepWarning(each.settings);
            warnings && !warning.empty() &&
            std::ranges::find(*warnings, warning) == warnings->end())
            warnings->push_back(warning);
        if (!checked.insert(files).second) continue;
        for (const std::string& warning :
             checkAssets(each.settings, scene.path, assets ? *assets : own, scene.reach))
            if (warnings && std::ranges::find(*warnings, warning) == warnings->end())
                warnings->push_back(warning);
    }
    return cases;
}

CaseSpec singleCase(Scene& scene, const SceneOptions& options, AssetStore* assets) {
    scene.axes.clear();
    return selectCases(scene, options, assets).front();
}

}  // namespace benchmarks::scene
