#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// PNG chunks: embedded text, the amount of picture data, and parts of new files (Portable Network
// Graphics, third edition, W3C 2025, sections 5 and 11.3.3).
namespace engine {

// Whether a file starts with the PNG signature.
bool isPng(std::string_view file);

// Returns the file with a text added as an iTXt chunk after the header. `file`: a PNG, complete
// or with its header alone.
// `keyword`: 1 to 79 letters, digits and hyphens. `text`: UTF-8 without zero bytes.
std::string withPngText(std::string_view file, std::string_view keyword, std::string_view text);

// Returns the raw bytes of the first text with this keyword in an iTXt, tEXt or zTXt chunk;
// programs that copy pictures convert between these kinds. Absent if no chunk has the keyword.
// Throws Error "byte N: reason" if the file is not a complete PNG, a chunk's checksum is wrong, or
// a compressed text is damaged or longer than 64 MiB.
std::optional<std::string> pngText(std::string_view file, std::string_view keyword);

// Rejects a PNG with data that inflate to more than twice the size its header implies. Decoders
// inflate all data first, and a megabyte can become a gigabyte. Also throws Error "byte N: reason"
// if the file is not a complete PNG or a chunk's checksum is wrong.
void checkPngData(std::string_view file);

// For writers of PNG files.
inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
// Returns a number in the four bytes that PNG has for it.
std::string pngNumber(std::uint32_t number);
// Returns a chunk: `type`, of four letters, and its data with their length and checksum.
std::string pngChunk(std::string_view type, std::string_view data);
// Returns the data of all chunks of a type, joined. Throws Error "byte N: reason" as pngText().
std::string pngChunks(std::string_view file, std::string_view type);

}  // namespace engine
