#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hair {

// What a binary glTF file holds (glTF 2.0, section 4.4).
struct GlbChunks {
    std::string_view json;
    std::string_view binary;  // empty where there is none
};

bool isGlb(std::string_view file);

// Throws engine::Error "byte N: reason" for a header and chunks that the file doesn't bear out.
GlbChunks glbChunks(std::string_view file);

// A file of these chunks.
std::string glbFile(const GlbChunks& chunks);

}  // namespace hair
