#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

// Reads the words of SPIR-V modules.

namespace engine {

// Operation codes: SPIR-V specification, 3.42.
namespace spirv {
constexpr std::uint32_t kSourceContinued = 2;
constexpr std::uint32_t kSource = 3;
constexpr std::uint32_t kString = 7;
constexpr std::uint32_t kFunction = 54;
constexpr std::uint32_t kDecorate = 71;
}  // namespace spirv

struct SpirvInstruction {
    std::uint32_t operation = 0;
    std::span<const std::uint32_t> operands;  // words
};

// Returns a SPIR-V string: UTF-8, four bytes a word, zero-terminated.
inline std::string spirvText(std::span<const std::uint32_t> words) {
    const std::string text(reinterpret_cast<const char*>(words.data()), words.size_bytes());
    return text.substr(0, text.find('\0'));
}

// Calls `use` for every instruction before the first function. Ends early if the code is not
// SPIR-V.
template <class Use>
void forEachDeclaration(std::span<const std::uint32_t> code, Use&& use) {
    constexpr std::size_t kHeaderWords = 5;
    for (std::size_t at = kHeaderWords; at < code.size();) {
        const std::size_t count = code[at] >> 16;
        const std::uint32_t operation = code[at] & 0xffff;
        if (operation == spirv::kFunction || count == 0 || count > code.size() - at) return;
        use(SpirvInstruction{operation, code.subspan(at + 1, count - 1)});
        at += count;
    }
}

// Judges the SPIR-V of functions that are not the program's own.

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
