#pragma once

#include <cstdlib>
#include <filesystem>

inline constexpr const char* kNoReference =
    "no Python environment for references: run scripts/setup --reference";

// Whether the environment of scripts/setup --reference exists.
inline bool hasReferencePython() {
    const char* wanted = std::getenv("HAIRBENCH_REFERENCE_PYTHON");
    return std::filesystem::exists(
        wanted && *wanted ? wanted : HAIRBENCH_SOURCE_DIR "/.deps/reference/bin/python");
}
