#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace benchmarks {

// The texts of files that others write. Editors save in steps (truncate, then write; or write
// beside, then rename), so that a file may be gone, empty or cut short for a moment: it counts as
// changed only once it looks the same at two looks running.
class WatchedFiles {
public:
    using Text = std::optional<std::string>;  // none: there is no such file

    explicit WatchedFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // From now on too. `text` is what it is taken for until a look finds another.
    void watch(const std::string& file, Text text);
    // Of a file that isn't watched yet: as it is now, and it is watched from now on.
    const Text& text(const std::string& file);

    // Looks at the files on disk. True where a text became another.
    bool look();

    const std::filesystem::path& folder() const { return folder_; }

private:
    struct Stamp {
        bool exists = false;
        std::filesystem::file_time_type time{};
        std::uintmax_t size = 0;

        bool operator==(const Stamp&) const = default;
    };
    struct File {
        Text text;
        std::optional<Stamp> read;  // when `text` was read; none: never
        std::optional<Stamp> seen;  // at the last look
    };

    Stamp stampOf(const std::string& file) const;
    Text read(const std::string& file) const;

    std::filesystem::path folder_;
    std::map<std::string, File, std::less<>> files_;
};

}  // namespace benchmarks
