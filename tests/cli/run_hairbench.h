#pragma once

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#ifndef _WIN32
#include <sys/wait.h>
#endif

// The program as a user runs it.
struct Outcome {
    int status;
    std::string output;
};

// A shipped scene as an argument.
inline std::string shippedScene(const std::string& name) {
    return "'" HAIRBENCH_SCENES_DIR "/" + name + "' ";
}

// The commands are for a POSIX shell. Throws on Windows, which has none.
inline Outcome runInShell(const std::string& command) {
#ifdef _WIN32
    throw std::runtime_error("no shell for " + command);
#else
    FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) throw std::runtime_error("popen failed");
    Outcome outcome{};
    std::array<char, 4096> part{};
    while (std::size_t count = fread(part.data(), 1, part.size(), pipe)) {
        outcome.output.append(part.data(), count);
    }
    outcome.status = WEXITSTATUS(pclose(pipe));
    return outcome;
#endif
}

// Runs hairbench and returns its stdout and stderr. `before` goes before the program's name.
inline Outcome hairbench(const std::string& arguments, const std::string& before = "") {
    return runInShell(before + "'" HAIRBENCH_PROGRAM "' " + arguments + " 2>&1");
}

// Runs hairbench and returns its stderr.
inline Outcome hairbenchErrors(const std::string& arguments, const std::string& before = "") {
    return runInShell(before + "'" HAIRBENCH_PROGRAM "' " + arguments + " 2>&1 >/dev/null");
}
