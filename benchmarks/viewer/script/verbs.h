#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "benchmarks/json_fwd.h"
#include "benchmarks/viewer/script/driver.h"

namespace benchmarks {

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
    Act (*read)(const Json& value, const std::string& pointer, const ScriptFolders& folders);
};

std::span<const Verb> verbTable();
// Throws engine::Error for one that is not in the table; `pointer` is the step's.
const Verb& verbNamed(const std::string& name, const std::string& pointer);

// ---- One for each row ---------------------------------------------------------------------------

Act readWait(const Json&, const std::string&, const ScriptFolders&);
Act readFrames(const Json&, const std::string&, const ScriptFolders&);
Act readPlay(const Json&, const std::string&, const ScriptFolders&);
Act readSeek(const Json&, const std::string&, const ScriptFolders&);
Act readSet(const Json&, const std::string&, const ScriptFolders&);
Act readPerform(const Json&, const std::string&, const ScriptFolders&);
Act readDrop(const Json&, const std::string&, const ScriptFolders&);
Act readResize(const Json&, const std::string&, const ScriptFolders&);
Act readMove(const Json&, const std::string&, const ScriptFolders&);
Act readClick(const Json&, const std::string&, const ScriptFolders&);
Act readDrag(const Json&, const std::string&, const ScriptFolders&);
Act readScroll(const Json&, const std::string&, const ScriptFolders&);
Act readKey(const Json&, const std::string&, const ScriptFolders&);
Act readType(const Json&, const std::string&, const ScriptFolders&);
Act readScreenshot(const Json&, const std::string&, const ScriptFolders&);
Act readPicture(const Json&, const std::string&, const ScriptFolders&);
Act readSave(const Json&, const std::string&, const ScriptFolders&);
Act readState(const Json&, const std::string&, const ScriptFolders&);
Act readExpect(const Json&, const std::string&, const ScriptFolders&);

}  // namespace benchmarks
