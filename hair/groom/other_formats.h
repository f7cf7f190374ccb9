#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Files that are not what their name says: formats that are known by their first bytes but not
// read, and texts that stand in a file's place. Readers of strands and of meshes name them.
namespace hair::groom {

// Bytes at the beginning of a file that recognise() looks at.
inline constexpr std::size_t kRecognisedBytes = 256;

struct OtherFile {
    std::string_view name;  // "a Blender file"
    std::string_view advice;  // what to do, an imperative clause
    // False if a few first bytes of a file of ours may be the same by chance.
    bool is_certain = true;

    // "is a Blender file, which is not read: export its curves as USD from Blender"
    std::string text() const;
};

// Returns the row of a file by its first bytes; null if it is none of these. `extension` is in
// lower case, with its dot: some formats of ours are kinds of others, such as archives.
const OtherFile* recognise(std::string_view head, std::string_view extension);

// Returns a reader's reason for refusing a file, with the name of the format that the file begins
// like, if any.
std::string explained(const std::string& reason, std::string_view head, std::string_view extension);

}  // namespace hair::groom
