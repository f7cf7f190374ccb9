#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/cli/run_hairbench.h"

// The interpreter in a folder of .deps/. Empty where there is none.
inline std::string interpreterOf(const std::string& environment) {
    const std::string made = HAIRBENCH_SOURCE_DIR "/.deps/" + environment + "/bin/python";
    return std::filesystem::exists(made) ? made : "";
}

// The interpreter of scripts/setup --python, for tests that hold the program against other
// people's libraries. Empty where there is none: skipWithout(Need::python, kNoPython).
inline std::string pythonInterpreter() {
    const char* wanted = std::getenv("HAIRBENCH_PYTHON");
    return wanted && *wanted ? wanted : interpreterOf("python");
}

inline constexpr const char* kNoPython = "no Python environment: run scripts/setup --python";

// Runs a script of the repository. `arguments` are for a shell.
inline Outcome runPython(
    const std::string& script, const std::string& arguments,
    const std::string& interpreter = pythonInterpreter()) {
    return runInShell(
        "'" + interpreter + "' -B '" HAIRBENCH_SOURCE_DIR "/" + script + "' " + arguments +
        " 2>&1");
}
