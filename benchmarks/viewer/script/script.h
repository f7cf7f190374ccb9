#pragma once

#include <filesystem>
#include <memory>

#include "benchmarks/viewer/viewer.h"
#include "engine/error.h"

namespace benchmarks::viewer {

// A step could not be done, or an expectation does not hold.
class ScriptFailure : public engine::Error {
public:
    using engine::Error::Error;
};

// A file of steps that drive the viewer as a user would: docs/viewer.md has them all. While it
// does, the user's own mouse and keys do nothing, and every picture of the window is 1/60 s after
// the one before, however long it took.
class Script {
public:
    // Throws engine::Error "<path>: <JSON pointer>: <reason>".
    explicit Script(const std::filesystem::path& path);
    // Before the viewer that it drives.
    ~Script();
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    // What comes before the window's next picture. False: all is done. Throws ScriptFailure
    // "<path>: <JSON pointer of the step>: <reason>".
    bool step(Viewer& viewer);

    // The window has closed. Throws ScriptFailure where steps are left.
    void finish() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks::viewer
