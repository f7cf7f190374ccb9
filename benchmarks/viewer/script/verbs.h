#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/script/input.h"

// The kinds of script steps.
namespace benchmarks::viewer {

// Runs one step. Throws engine::Error with only the reason.
using Act = std::function<void(Driver&)>;

// Folders of a script: it reads files beside itself and writes files to its "out", relative to the
// current folder.
struct ScriptFolders {
    std::filesystem::path script;
    std::filesystem::path out;
};

// A kind of step.
struct Verb {
    const char* name;
    // `value` is the step's value, at `pointer` in the script. Throws engine::Error
    // "<JSON pointer>: <reason>".
    Act (*read)(const scene::Json& value, const std::string& pointer, const ScriptFolders& folders);
};

// Throws engine::Error for an unknown verb; `pointer` is the step's.
const Verb& verbNamed(const std::string& name, const std::string& pointer);

}  // namespace benchmarks::viewer
