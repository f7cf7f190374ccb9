#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

// Judges the SPIR-V of functions that are not the program's own.
namespace engine {

// The first fault of a module.
struct SpirvFault {
    std::string file;  // from the module's OpLine; empty: unknown
    int line = 0;  // from 1; 0: unknown
    std::string text;
};

// Judges a module with one entry point. It may hold functions that compute with values and local
// variables and read nothing but their parameters and constants. Capabilities, storage classes
// (only Function), instructions and decorations that are not on an allow list are faults, as are
// numbers that don't have 32 bits and pointers in memory. Bounds the size too, with the body of
// each function counted at each call, because drivers inline calls. Returns none for a module
// without faults. `code` may be any words. The judge is no validator: it may pass code that
// spirv-val refuses.
std::optional<SpirvFault> judgeSpirv(std::span<const std::uint32_t> code);

}  // namespace engine
