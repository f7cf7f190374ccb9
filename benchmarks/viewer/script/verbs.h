#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/viewer/script/input.h"

namespace benchmarks::viewer {

// What one step does. Throws engine::Error, the reason alone.
using Act = std::function<void(Driver&)>;

// Where a script's files are: those it reads beside it, those it writes in its "out", which is
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

std::span<const Verb> verbTable();
// Throws engine::Error for one that is not in the table; `pointer` is the step's.
const Verb& verbNamed(const std::string& name, const std::string& pointer);

// ---- One for each row ---------------------------------------------------------------------------

Act readWait(const scene::Json&, const std::string&, const ScriptFolders&);
Act readFrames(const scene::Json&, const std::string&, const ScriptFolders&);
Act readPlay(const scene::Json&, const std::string&, const ScriptFolders&);
Act readSeek(const scene::Json&, const std::string&, const ScriptFolders&);
Act readSet(const scene::Json&, const std::string&, const ScriptFolders&);
Act readPerform(const scene::Json&, const std::string&, const ScriptFolders&);
Act readDrop(const scene::Json&, const std::string&, const ScriptFolders&);
Act readResize(const scene::Json&, const std::string&, const ScriptFolders&);
Act readMove(const scene::Json&, const std::string&, const ScriptFolders&);
Act readClick(const scene::Json&, const std::string&, const ScriptFolders&);
Act readDrag(const scene::Json&, const std::string&, const ScriptFolders&);
Act readScroll(const scene::Json&, const std::string&, const ScriptFolders&);
Act readKey(const scene::Json&, const std::string&, const ScriptFolders&);
Act readType(const scene::Json&, const std::string&, const ScriptFolders&);
Act readScreenshot(const scene::Json&, const std::string&, const ScriptFolders&);
Act readPicture(const scene::Json&, const std::string&, const ScriptFolders&);
Act readSave(const scene::Json&, const std::string&, const ScriptFolders&);
Act readState(const scene::Json&, const std::string&, const ScriptFolders&);
Act readExpect(const scene::Json&, const std::string&, const ScriptFolders&);

}  // namespace benchmarks::viewer
