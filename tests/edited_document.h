#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"

// Sets a value of a document, or merges an object into an object (RFC 7386). A reference for edits
// of typed settings: it knows no tables.
inline void editDocument(
    benchmarks::scene::Json& document, const std::string& pointer,
    const benchmarks::scene::Json& value) {
    benchmarks::scene::Json& place = document.at(benchmarks::scene::Json::json_pointer(pointer));
    if (place.is_object() && value.is_object())
        place.merge_patch(value);
    else
        place = value;
}
