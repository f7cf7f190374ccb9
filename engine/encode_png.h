#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace engine {

// The file of a PNG of RGBA pixels, [row][column], top row first. Throws Error.
std::string
encodePng(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgba);

}  // namespace engine
