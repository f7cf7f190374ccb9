#include "benchmarks/hash.h"

#include <cstdint>

namespace benchmarks {

std::string hashBytes(std::span<const std::byte> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;  // offset basis
    for (const std::byte byte : bytes) {
        hash ^= static_cast<std::uint64_t>(byte);
        hash *= 0x00000100000001b3u;  // prime
    }
    std::string digits(16, '0');
    for (std::size_t i = digits.size(); i-- > 0; hash >>= 4)
        digits[i] = "0123456789abcdef"[hash & 0xf];
    return digits;
}

std::string hashText(std::string_view text) { return hashBytes(std::as_bytes(std::span(text))); }

}  // namespace benchmarks
