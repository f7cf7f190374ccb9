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

// A file of steps that drive the viewer as a user would: docs/viewer.md has them all. Meanwhile the
// user's own mouse and keys do nothing, and every picture of the window is 1/60 s after
// the one before, however long it took.
class Script {
public:
    // Throws engine::Error "<path>: <JSON pointer>: <reason>".
    explicit Script(const std::filesystem::path& path);
    // Must be destroyed before the viewer that it drives.
    ~Script();
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    // Does what comes before the window's next picture; false once all is done. Throws
    // ScriptFailure
    // "<path>: <JSON pointer of the step>: <reason>".
    bool step(Viewer& viewer);

    // To be called once the window has closed. Throws ScriptFailure where steps are left.
    void finish() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks::viewer
