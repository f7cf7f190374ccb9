#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <span>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "tests/fuzz/targets.h"

// One libFuzzer program for all targets. $HAIRBENCH_FUZZ_TARGET chooses the target, otherwise the
// program's own name does. OSS-Fuzz calls it e.g. fuzz_scene.
namespace {

const fuzz::Target* chosen = nullptr;

std::string wantedName(std::string_view program) {
    if (const char* const name = std::getenv("HAIRBENCH_FUZZ_TARGET")) return name;
    const std::string called = std::filesystem::path(program).filename().string();
    constexpr std::string_view kBefore = "fuzz_";
    return called.starts_with(kBefore) ? called.substr(kBefore.size()) : called;
}

void chooseTarget(std::string_view program) {
    try {
        chosen = &fuzz::targetNamed(wantedName(program));
    } catch (const std::exception& error) {
        std::fprintf(
            stderr, "%s; HAIRBENCH_FUZZ_TARGET is one of those that --targets lists\n",
            error.what());
        std::exit(2);
    }
}

// Prints a line for each target: its name and its options for libFuzzer.
void listTargets() {
    for (const fuzz::Target& target : fuzz::targets())
        std::printf(
            "%s -max_len=%zu -malloc_limit_mb=%zu -timeout=%zu\n", target.name.c_str(),
            target.limits.length, target.limits.allocation, target.limits.seconds);
}

void listSeeds() {
    for (const std::filesystem::path& file : fuzz::seedsOf(*chosen))
        std::printf("%s\n", file.c_str());
}

}  // namespace

// --targets lists the targets, --seeds the files to start from. Called by libFuzzer.
extern "C" __attribute__((visibility("default"))) int
LLVMFuzzerInitialize(const int* argc, const char* const* const* argv) {
    const std::span<const char* const> arguments(*argv, static_cast<std::size_t>(*argc));
    const auto is_given = [&](std::string_view option) {
        return std::ranges::find(arguments, option) != arguments.end();
    };
    if (is_given("--targets")) {
        listTargets();
        std::exit(0);
    }
    chooseTarget(arguments.front());
    if (is_given("--seeds")) {
        listSeeds();
        std::exit(0);
    }
    std::cerr.rdbuf(nullptr);  // silences messages about each file
    return 0;
}

// A target refuses the bytes with an engine::Error or reads them correctly. With
// $HAIRBENCH_FUZZ_SAYS it prints the reason for a refusal. Called by libFuzzer.
extern "C" __attribute__((visibility("default"))) int
LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
    try {
        chosen->read({reinterpret_cast<const char*>(bytes), size});
    } catch (const engine::Error& error) {
        static const bool says = std::getenv("HAIRBENCH_FUZZ_SAYS") != nullptr;
        if (says) std::fprintf(stderr, "refused: %s\n", error.what());
    }
    return 0;
}
