#include "benchmarks/measure/disk_cache.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "benchmarks/report/environment.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::measure {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "hairbench-cache 1\n";
constexpr std::string_view kExtension = ".entry";

// Partial files older than this were left by a process that was killed while writing.
constexpr std::chrono::hours kStale{1};

struct Header {
    std::uint64_t key_size = 0;
    std::uint64_t size = 0;
    std::array<char, 16> hash{};  // report::hashText() of the key and the bytes
};

Header headerOf(const std::string& key, const std::string& bytes) {
    Header header{.key_size = key.size(), .size = bytes.size()};
    const std::string hash = report::hashText(report::hashText(key) + report::hashText(bytes));
    std::ranges::copy(hash, header.hash.begin());
    return header;
}

}  // namespace

fs::path hairCacheFolder() {
    const fs::path folder = engine::userCacheFolder();
    return folder.empty() ? folder : folder / "hair";
}

fs::path DiskCache::fileOf(const std::string& key) const {
    return options_.folder / (report::hashText(key) + std::string(kExtension));
}

void DiskCache::warn(const std::string& key, const std::string& reason) const {
    if (options_.warn) options_.warn(fileOf(key).string() + ": " + reason + "; it is ignored");
}

std::optional<std::string> DiskCache::load(const std::string& key) const {
    if (!isOn()) return std::nullopt;
    const fs::path path = fileOf(key);
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return std::nullopt;  // missing, or not a regular file
    const auto unusable = [&](const char* reason) {
        warn(key, reason);
        return std::nullopt;
    };

    std::ifstream file(path, std::ios::binary);
    std::string magic(kMagic.size(), '\0');
    Header header;
    file.read(magic.data(), static_cast<std::streamsize>(magic.size()));
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!file || magic != kMagic) return unusable("is not an entry of this cache");
    if (size > options_.most_bytes) return unusable("is damaged");  // larger than the whole cache
    const std::uintmax_t body = size - kMagic.size() - sizeof header;
    if (header.key_size > body || header.size != body - header.key_size)
        return unusable("is damaged");
    std::string found(header.key_size, '\0');
    std::string bytes(header.size, '\0');
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file || headerOf(found, bytes).hash != header.hash) return unusable("is damaged");
    if (found != key) return unusable("belongs to other data");
    fs::last_write_time(path, fs::file_time_type::clock::now(), error);  // marks it as used
    return bytes;
}

void DiskCache::store(const std::string& key, const std::string& bytes) const {
    if (!takes(bytes.size())) return;
    const fs::path path = fileOf(key);
    const Header header = headerOf(key, bytes);
    try {
        engine::replaceFile(path, [&](std::ostream& file) {
            file.write(kMagic.data(), kMagic.size());
            file.write(reinterpret_cast<const char*>(&header), sizeof header);
            file.write(key.data(), static_cast<std::streamsize>(key.size()));
            file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        });
    } catch (const engine::Error&) {  // the next run makes it again
    }
    trim();
}

void DiskCache::trim() const {
    struct Entry {
        fs::path path;
        fs::file_time_type used;
        std::uintmax_t size;
    };
    std::vector<Entry> entries;
    std::uintmax_t bytes = 0;
    std::error_code error;
    const fs::file_time_type now = fs::file_time_type::clock::now();
    for (const fs::directory_entry& each : fs::directory_iterator(options_.folder, error)) {
        std::error_code gone;  // another process may have removed it
        const Entry entry{each.path(), each.last_write_time(gone), each.file_size(gone)};
        if (gone) continue;
        if (entry.path.extension() == kExtension) {
            bytes += entry.size;
            entries.push_back(entry);
        } else if (
            entry.path.filename().string().find(std::string(kExtension) + '.') !=
                std::string::npos &&
            now - entry.used > kStale) {
            fs::remove(entry.path, gone);
        }
    }
    std::ranges::sort(entries, {}, &Entry::used);
    for (const Entry& entry : entries) {
        if (bytes <= options_.most_bytes) break;
        fs::remove(entry.path, error);
        bytes -= entry.size;
    }
}

}  // namespace benchmarks::measure
