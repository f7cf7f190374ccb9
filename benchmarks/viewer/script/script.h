#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/script/input.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/error.h"

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

// A step could not be done, or an expectation was not met.
class ScriptFailure : public engine::Error {
public:
    using engine::Error::Error;
};

// A file of steps that drive the viewer like a user: docs/viewer.md lists them all. Meanwhile the
// user's own mouse and keys do nothing, and each picture of the window is 1/60 s after the previous
// one, however long it took.
class Script {
public:
    // Throws engine::Error "<path>: <JSON pointer>: <reason>".
    explicit Script(const std::filesystem::path& path);
    // Must be destroyed before the viewer that it drives.
    ~Script();
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    // Runs the actions before the window's next picture; false when all are done. Throws
    // ScriptFailure "<path>: <JSON pointer of the step>: <reason>".
    bool step(Viewer& viewer);

    // Call this after the window has closed. Throws ScriptFailure if steps remain.
    void finish() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks::viewer
