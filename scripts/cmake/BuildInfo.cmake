# cmake -DOUTPUT=build_info.h -DSOURCE=… -DVERSION=… -DCOMPILER=… -DTYPE=… -DFLAGS=…
#     -P BuildInfo.cmake
# Runs at every build, because the commit can change without a new CMake run. Touches the file only
# if its contents change.
find_program(GIT git)
set(commit "")
set(dirty false)
if(GIT)
    execute_process(COMMAND "${GIT}" -C "${SOURCE}" rev-parse --short=12 HEAD
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    execute_process(COMMAND "${GIT}" -C "${SOURCE}" status --porcelain --untracked-files=no
        OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(commit AND changes)
        string(APPEND commit "-dirty")
        set(dirty true)
    endif()
endif()
string(STRIP "${FLAGS}" flags)
string(REGEX REPLACE " +" " " flags "${flags}")
# Escaped for a C++ string.
string(REPLACE "\\" "\\\\" flags "${flags}")
string(REPLACE "\"" "\\\"" flags "${flags}")
set(text "#pragma once
inline constexpr const char* kBuildVersion = \"${VERSION}\";
inline constexpr const char* kBuildCommit = \"${commit}\";
inline constexpr bool kBuildDirty = ${dirty};
inline constexpr const char* kBuildCompiler = \"${COMPILER}\";
inline constexpr const char* kBuildType = \"${TYPE}\";
inline constexpr const char* kBuildFlags = \"${flags}\";
")
set(old "")
if(EXISTS "${OUTPUT}")
    file(READ "${OUTPUT}" old)
endif()
if(NOT text STREQUAL old)
    file(WRITE "${OUTPUT}" "${text}")
endif()
