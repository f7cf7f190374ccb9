#include "benchmarks/viewer/shaders/watched_files.h"

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace benchmarks {

void WatchedFiles::watch(const std::string& file, Text text) {
    files_.try_emplace(file, File{.text = std::move(text), .read = {}, .seen = {}});
}

const WatchedFiles::Text& WatchedFiles::text(const std::string& file) {
    const auto [found, is_new] = files_.try_emplace(file);
    if (is_new) {
        found->second.read = found->second.seen = stampOf(file);
        found->second.text = read(file);
    }
    return found->second.text;
}

bool WatchedFiles::look() {
    bool changed = false;
    for (auto& [name, file] : files_) {
        const Stamp stamp = stampOf(name);
        const bool rests = file.seen == stamp;
        file.seen = stamp;
        if (!rests || file.read == stamp) continue;
        file.read = stamp;
        Text now = read(name);
        if (now == file.text) continue;
        file.text = std::move(now);
        changed = true;
    }
    return changed;
}

WatchedFiles::Stamp WatchedFiles::stampOf(const std::string& file) const {
    const std::filesystem::path path = folder_ / file;
    std::error_code time_error, size_error;
    const auto time = std::filesystem::last_write_time(path, time_error);
    const auto size = std::filesystem::file_size(path, size_error);
    if (time_error || size_error) return {};
    return {.exists = true, .time = time, .size = size};
}

WatchedFiles::Text WatchedFiles::read(const std::string& file) const {
    std::ifstream stream(folder_ / file, std::ios::binary);
    if (!stream) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace benchmarks
