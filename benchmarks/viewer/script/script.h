#pragma once

#include <filesystem>
#include <memory>

#include "benchmarks/viewer/viewer.h"
#include "engine/error.h"

namespace benchmarks::viewer {

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
