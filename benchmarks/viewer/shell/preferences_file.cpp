#include "benchmarks/viewer/shell/preferences_file.h"

#include "engine/error.h"
#include "engine/read_file.h"
#include "engine/write_file.h"

namespace benchmarks {

PreferencesFile::PreferencesFile(const std::filesystem::path& path) : path_(path) {
    std::error_code none;
    if (path_.empty() || !std::filesystem::exists(path_, none)) return;
    try {
        now = readPreferences(engine::readFile(path_));
    } catch (const engine::Error& error) {
        problem_ = std::string("preferences are ignored: ") + error.what();
    }
    kept_ = now;
}

void PreferencesFile::keep() {
    if (path_.empty() || now == kept_) return;
    kept_ = now;
    try {
        engine::writeFileAtomically(path_, preferencesText(now));
    } catch (const engine::Error& error) {
        problem_ = std::string("preferences are not kept: ") + error.what();
        path_.clear();
    }
}

}  // namespace benchmarks
