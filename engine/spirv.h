#pragma once

#include <cstdint>
#include <span>

namespace engine {

// Operations of the SPIR-V specification, 3.42.
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

// Calls `use` for every instruction before the first function. Ends early in what is no SPIR-V.
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

}  // namespace engine
