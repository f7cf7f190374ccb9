#pragma once

#include <concepts>
#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

namespace hair::groom {

// Called for every file that another file names (buffers and pictures of a glTF file, textures of a
// mesh) before it is opened. An exception of it ends the reading. Empty: as
// ownFolderOnly() of the file.
class NamedFileCheck {
public:
    NamedFileCheck() = default;
    // `folders` are the canonical folders in which a program that reads the file may open others;
    // empty: everywhere.
    template <std::invocable<const std::filesystem::path&> Check>
    NamedFileCheck(Check check, std::vector<std::filesystem::path> folders = {})
        : check_(std::move(check)), folders_(std::move(folders)) {}

    explicit operator bool() const { return check_ != nullptr; }
    void operator()(const std::filesystem::path& file) const { check_(file); }
    const std::vector<std::filesystem::path>& folders() const { return folders_; }

private:
    std::function<void(const std::filesystem::path& file)> check_;
    std::vector<std::filesystem::path> folders_;
};

// Returns the path with links resolved as far as it exists.
std::filesystem::path placeOf(const std::filesystem::path& path);

// True if the file lies in the folder or below. Both paths are from placeOf().
bool isBelow(const std::filesystem::path& file, const std::filesystem::path& folder);

// Returns a check that refuses files outside the folder of `file`, after links are followed.
NamedFileCheck ownFolderOnly(const std::filesystem::path& file);

// Returns the check, or ownFolderOnly() if it is empty.
inline NamedFileCheck orOwnFolder(const NamedFileCheck& check, const std::filesystem::path& file) {
    return check ? check : ownFolderOnly(file);
}

// Returns the folders that a program may read for a file with this check (engine::ChildLimits).
inline std::vector<std::filesystem::path> readsOf(const NamedFileCheck& check) {
    return check.folders().empty() ? std::vector<std::filesystem::path>{"/"} : check.folders();
}

}  // namespace hair::groom
