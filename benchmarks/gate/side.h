#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/select_cases.h"
#include "benchmarks/decide/verdict.h"

namespace benchmarks {

struct GateOptions {
    std::string a;  // build folder, program, or command line
    std::string b;
    SceneOptions scene;
    std::string filter;
    std::vector<std::string> a_sets;  // "POINTER=VALUE" for A's or B's runs alone
    std::vector<std::string> b_sets;
    std::uint32_t pairs = 12;
    std::uint32_t calibration = 0;  // A/A pairs before the gate; 0: none
    VerdictOptions verdict;
    std::filesystem::path out;  // report of the gate; empty: results/local/gate-<scene>.json
    std::vector<std::string> command;
};

// One of the two that a gate compares: what is run for each of its blocks.
struct Side {
    char name = 'A';
    std::string text;  // as the user gave it
    // A shell command with {scene} and {out} in it, and {seed} if it wants it; empty: `program`.
    std::string pattern;
    std::vector<std::string> program;  // that "run SCENE --out OUT ..." is added to
    std::vector<std::string> options;  // of this side's runs, after those
};

// The side that --a or --b names: a build folder, a program, a command line for the shell, or one
// with places for scene and report, which is taken as it is. Throws engine::Error "--a TEXT: ...":
// a folder without a program, a pattern without {out}, options that a pattern would not get.
Side parseSide(char name, const GateOptions& options);

// How long each mode of a block goes on unless --max-time says otherwise. What one process is off
// by does not average out within it: many short processes tell more than few long ones. A GPU
// raises its clocks in that time.
inline constexpr double kBlockSeconds = 0.5;

// The command of one block.
std::vector<std::string> blockCommand(
    const Side& side, const std::filesystem::path& scene, const std::filesystem::path& out,
    std::uint32_t seed);

}  // namespace benchmarks
