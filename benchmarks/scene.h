#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/axis.h"
#include "benchmarks/json_text.h"
#include "benchmarks/read_sweep.h"
#include "hair/settings.h"

namespace benchmarks {

// A scene file, checked: hair::Settings members plus
//   "$schema"  a string for editors, ignored
//   "base"     another scene file, relative to this one; this document is applied to it as a JSON
//              merge patch (RFC 7386), so null takes a member of the base away
//   "sweep"    JSON pointer -> array of values, and the members in read_sweep.h; one case for each
//              combination, in the written order
// A screenshot of the viewer is one too: a PNG with the text of a scene file in it.
struct Scene {
    std::filesystem::path path;  // as given
    std::filesystem::path directory;  // what file names in the scene are relative to
    std::string name;  // file name without its extension
    Document document;  // what is written, bases merged, without the three members above
    Document resolved;  // every field, absent ones with their defaults
    hair::Settings settings;  // of `resolved`: no axis applied
    std::vector<Axis> axes;
    std::vector<Exclusion> exclusions;  // of what the axes make: without axes they mean nothing
};

// Reads and checks everything but the rules between fields, which hold for cases: expand() checks
// those. Throws engine::Error, one line: "<file>: <JSON pointer>: <reason>"; what is wrong in a
// base is reported as "<file>: /base: <base file>: ...".
Scene loadScene(const std::filesystem::path& path);

// Sets one field of every case, as if the file had it. Throws engine::Error "<JSON pointer>:
// <reason>".
void setField(Scene& scene, const std::string& pointer, const Json& value);

}  // namespace benchmarks
