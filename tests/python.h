#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/cli/run_hairbench.h"

// The interpreter of scripts/setup --python, for tests that hold the program against other
// people's libraries. Empty where there is none: skipWithout(Need::python, kNoPython).
inline std::string pythonInterpreter() {
    const char* wanted = std::getenv("HAIRBENCH_PYTHON");
    if (wanted && *wanted) return wanted;
    const std::string made = HAIRBENCH_SOURCE_DIR "/.deps/python/bin/python";
    return std::filesystem::exists(made) ? made : "";
}

inline constexpr const char* kNoPython = "no Python environment: run scripts/setup --python";

// Runs a script of the repository. `arguments` are for a shell.
inline Outcome runPython(const std::string& script, const std::string& arguments) {
    return runInShell(
        "'" + pythonInterpreter() + "' -B '" HAIRBENCH_SOURCE_DIR "/" + script + "' " + arguments +
        " 2>&1");
}
