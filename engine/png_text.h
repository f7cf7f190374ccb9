#pragma once

#include <optional>
#include <string>
#include <string_view>

// The chunks of a PNG: texts beside the picture, and how much the picture is (Portable Network
// Graphics, third edition, W3C 2025, sections 5 and 11.3.3).
namespace engine {

// Whether a file begins as every PNG does.
bool isPng(std::string_view file);

// The file with a text, UTF-8 without zero bytes, as an iTXt chunk after its header. `keyword`: 1
// to 79 letters, digits and hyphens. `file` is a whole PNG.
std::string withPngText(std::string_view file, std::string_view keyword, std::string_view text);

// The first text with this keyword, of an iTXt, tEXt or zTXt chunk, as its bytes are; programs that
// copy pictures turn one kind into another. Absent where no chunk has it. Throws Error "byte N:
// reason" for what is no whole PNG or has a chunk whose checksum is wrong, and for a compressed
// text that can't be read or is longer than 64 MiB.
std::optional<std::string> pngText(std::string_view file, std::string_view keyword);

// Refuses a PNG whose data inflate to over twice what a picture of its header's size is: decoders
// inflate all of them first, and a megabyte can be a gigabyte. Throws Error "byte N: reason" too
// for what is no whole PNG or has a chunk whose checksum is wrong.
void checkPngData(std::string_view file);

}  // namespace engine
