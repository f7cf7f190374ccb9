#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/cli/run_hairbench.h"

// Returns the interpreter in a folder of .deps/; empty if there is none.
inline std::string interpreterOf(const std::string& environment) {
#ifdef _WIN32
    const std::string program = "/Scripts/python.exe";
#else
    const std::string program = "/bin/python";
#endif
    const std::string made = HAIRBENCH_SOURCE_DIR "/.deps/" + environment + program;
    return std::filesystem::exists(made) ? made : "";
}

// Returns the interpreter of scripts/setup --python, for tests that compare the program with other
// libraries. If it is empty, skip the test by skipWithout(Need::python, kNoPython).
inline std::string pythonInterpreter() {
    const char* wanted = std::getenv("HAIRBENCH_PYTHON");
    return wanted && *wanted ? wanted : interpreterOf("python");
}

inline constexpr const char* kNoPython = "no Python environment: run scripts/setup --python";

// Runs a script of the repository. A shell reads `arguments`.
inline Outcome runPython(
    const std::string& script, const std::string& arguments,
    const std::string& interpreter = pythonInterpreter()) {
    return runInShell(
        "'" + interpreter + "' -B '" HAIRBENCH_SOURCE_DIR "/" + script + "' " + arguments +
        " 2>&1");
}
