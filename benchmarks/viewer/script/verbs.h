#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/script/input.h"

// The kinds of steps that scripts have.
namespace benchmarks::viewer {

// What one step does. Throws engine::Error, the reason alone.
using Act = std::function<void(Driver&)>;

// Where a script's files are: it reads files beside it, and writes files to its "out", which is
// relative to the current folder.
struct ScriptFolders {
    std::filesystem::path script;
    std::filesystem::path out;
};

// A kind of step.
struct Verb {
    const char* name;
    // `value` is what the step gives it, at `pointer` in the script. Throws engine::Error
    // "<JSON pointer>: <reason>".
    Act (*read)(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders);
};

// Throws engine::Error for a verb that is not in the table; `pointer` is the step's.
const Verb& verbNamed(const std::string& name, const std::string& pointer);

}  // namespace benchmarks::viewer
