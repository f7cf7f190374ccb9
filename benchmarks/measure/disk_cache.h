#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

// Cache on disk for data that takes long to make, kept between runs.
namespace benchmarks::measure {

struct DiskCacheOptions {
    // Created at the first store; empty: nothing is kept.
    std::filesystem::path folder;
    std::uint64_t most_bytes = std::uint64_t{1} << 30;  // sum over all entries
    // Called with a message for each unusable entry; may be empty.
    std::function<void(const std::string&)> warn{};
};

// $XDG_CACHE_HOME/hairbench/hair, or the same in ~/.cache; empty without a home directory.
std::filesystem::path hairCacheFolder();

// Keeps one file per entry. The file's name is a hash of the key; the file holds the whole key and
// a hash of the bytes, so damaged, truncated and foreign entries are rejected. Processes may share
// a folder: files are written under another name and then renamed. The least recently used entries
// are removed first. A failed write is not an error; the entry is just not kept.
class DiskCache {
public:
    explicit DiskCache(DiskCacheOptions options) : options_(std::move(options)) {}

    bool isOn() const { return !options_.folder.empty(); }

    // Absent if the entry is missing or unusable; unusable entries are reported to `warn`.
    std::optional<std::string> load(const std::string& key) const;

    // True if an entry of this size is kept: at most a quarter of most_bytes.
    bool takes(std::size_t bytes) const { return isOn() && bytes <= options_.most_bytes / 4; }
    void store(const std::string& key, const std::string& bytes) const;

    // Path of an entry's file.
    std::filesystem::path fileOf(const std::string& key) const;

    // Reports that an entry's bytes are invalid.
    void warn(const std::string& key, const std::string& reason) const;

private:
    void trim() const;

    DiskCacheOptions options_;
};

}  // namespace benchmarks::measure
