#include "benchmarks/gate/side.h"

#include <system_error>

#include "benchmarks/decimal_text.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

namespace fs = std::filesystem;

bool isProgram(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

fs::path programOfBuild(const fs::path& folder, const std::string& context) {
    for (const fs::path& each : {folder / "benchmarks" / "hairbench", folder / "hairbench"})
        if (isProgram(each)) return each;
    throw engine::Error(context, "holds neither benchmarks/hairbench nor hairbench");
}

// A file name without a slash would be looked for in PATH.
std::string runnable(const fs::path& program) {
    return program.has_parent_path() ? program.string() : "./" + program.string();
}

// A command line of the shell that takes arguments after those it has.
std::vector<std::string> shellProgram(const std::string& text) {
    return {"/bin/sh", "-c", text + " \"$@\"", "hairbench gate"};
}

void addRepeated(
    std::vector<std::string>& options, const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) options.insert(options.end(), {option, value});
}

// What the user asked for of the runs of this side.
std::vector<std::string> runOptions(char name, const GateOptions& options) {
    std::vector<std::string> all;
    const SceneOptions& scene = options.scene;
    addRepeated(all, "--axis", scene.axes);
    addRepeated(all, "--set", scene.sets);
    addRepeated(all, "--set", name == 'A' ? options.a_sets : options.b_sets);
    if (!options.filter.empty()) addRepeated(all, "--filter", {options.filter});
    if (!scene.device.wanted.empty()) addRepeated(all, "--device", {scene.device.wanted});
    if (scene.frames) addRepeated(all, "--frames", {std::to_string(*scene.frames)});
    if (scene.warmup) addRepeated(all, "--warmup", {std::to_string(*scene.warmup)});
    if (scene.precision) addRepeated(all, "--precision", {decimalText(*scene.precision)});
    if (scene.max_time) addRepeated(all, "--max-time", {decimalText(*scene.max_time)});
    return all;
}

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char each : text) result += each == '\'' ? std::string("'\\''") : std::string{each};
    return result + "'";
}

void replaceAll(std::string& text, const std::string& what, const std::string& with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
        text.replace(at, what.size(), with);
}

bool isPattern(const std::string& text) {
    return text.find("{out}") != std::string::npos || text.find("{scene}") != std::string::npos;
}

}  // namespace

Side parseSide(char name, const GateOptions& options) {
    Side side{.name = name, .text = name == 'A' ? options.a : options.b};
    const std::string context = (name == 'A' ? "--a " : "--b ") + side.text;
    if (side.text.empty()) throw engine::Error(context, "is empty");
    side.options = runOptions(name, options);
    if (isPattern(side.text)) {
        if (side.text.find("{out}") == std::string::npos)
            throw engine::Error(context, "has {scene} but no {out}, where the report is to go");
        if (!side.options.empty())
            throw engine::Error(
                context, "has {out} and is taken as it is: put '" + side.options.front() +
                             "' into the command itself");
        side.pattern = side.text;
        return side;
    }
    if (!options.scene.max_time)
        addRepeated(side.options, "--max-time", {decimalText(kBlockSeconds)});
    std::error_code ignored;
    if (fs::is_directory(side.text, ignored))
        side.program = {runnable(programOfBuild(side.text, context))};
    else if (isProgram(side.text))
        side.program = {runnable(side.text)};
    else
        side.program = shellProgram(side.text);
    return side;
}

std::vector<std::string>
blockCommand(const Side& side, const fs::path& scene, const fs::path& out, std::uint32_t seed) {
    if (!side.pattern.empty()) {
        std::string command = side.pattern;
        replaceAll(command, "{scene}", quoted(scene.string()));
        replaceAll(command, "{out}", quoted(out.string()));
        replaceAll(command, "{seed}", std::to_string(seed));
        return {"/bin/sh", "-c", command};
    }
    std::vector<std::string> command = side.program;
    command.insert(
        command.end(), {"run", scene.string(), "--out", out.string(), "--no-pictures",
                        "--order-seed", std::to_string(seed)});
    command.insert(command.end(), side.options.begin(), side.options.end());
    return command;
}

}  // namespace benchmarks
