#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace benchmarks {

// 64-bit FNV-1a (Fowler, Noll and Vo 1991) of the bytes in memory order, as 16 lower-case hex
// digits. Reports use it for pictures, simulation states and documents: it tells whether two runs
// made the same thing, and is no protection against someone who wants two things to look the same.
std::string hashBytes(std::span<const std::byte> bytes);
std::string hashText(std::string_view text);

}  // namespace benchmarks
