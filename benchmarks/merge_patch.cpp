#include "benchmarks/merge_patch.h"

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "benchmarks/pointer.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

void requireRemovable(
    const Json& target, const Json& known, const std::string& key, const std::string& pointer) {
    if (target.contains(key) || known.contains(key)) return;
    std::vector<std::string> names;
    for (const Json* object : {&known, &target})
        for (const auto& [name, value] : object->items())
            if (object == &known || !known.contains(name)) names.push_back(name);
    throw engine::Error(
        pointer, names.empty() ? "the base has nothing to remove here"
                               : unknownName("nothing to remove", key, names));
}

void merge(Json& target, const Json& patch, const Json& known, const std::string& pointer) {
    if (!target.is_object()) target = Json::object();
    for (const auto& [key, value] : patch.items()) {
        const std::string here = pointer + '/' + escapedToken(key);
        const auto found = known.find(key);
        const bool is_known = found != known.end() && found->is_object();
        if (value.is_null()) {
            requireRemovable(target, known, key, here);
            target.erase(key);
        } else if (value.is_object()) {
            merge(target[key], value, is_known ? *found : Json::object(), here);
        } else {
            target[key] = value;
        }
    }
}

}  // namespace

void mergePatch(Json& target, const Json& patch, const Json& known) {
    merge(target, patch, known, "");
}

}  // namespace benchmarks
