#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

// Bytes that take long to make, kept on disk between runs.
namespace benchmarks::measure {

struct DiskCacheOptions {
    // Made when there is something to keep; empty: nothing is kept.
    std::filesystem::path folder;
    std::uint64_t most_bytes = std::uint64_t{1} << 30;  // of all entries
    // Told of entries that can't be used; may be empty.
    std::function<void(const std::string&)> warn{};
};

// $XDG_CACHE_HOME/hairbench/hair, or in ~/.cache; empty where there is no home.
std::filesystem::path hairCacheFolder();

// A file for each entry, named for a hash of its key, with the key whole and a hash of the bytes in
// it: what is damaged, cut off or of something else is not taken. Processes may share a folder:
// files are written beside and renamed. Those that were used longest ago go first. What can't be
// written is not kept, and that is no error.
class DiskCache {
public:
    explicit DiskCache(DiskCacheOptions options) : options_(std::move(options)) {}

    bool isOn() const { return !options_.folder.empty(); }

    // Absent where it is not there, or not usable, of which `warn` is told.
    std::optional<std::string> load(const std::string& key) const;

    // Whether an entry of that size is kept: not where it is more than a quarter of most_bytes.
    bool takes(std::size_t bytes) const { return isOn() && bytes <= options_.most_bytes / 4; }
    void store(const std::string& key, const std::string& bytes) const;

    // Where an entry is.
    std::filesystem::path fileOf(const std::string& key) const;

    // Says that an entry's bytes are not what they should be.
    void warn(const std::string& key, const std::string& reason) const;

private:
    void trim() const;

    DiskCacheOptions options_;
};

}  // namespace benchmarks::measure
