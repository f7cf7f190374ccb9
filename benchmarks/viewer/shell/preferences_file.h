#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/viewer/shell/preferences.h"

namespace benchmarks {

// The preferences and the file that they are kept in.
class PreferencesFile {
public:
    // An empty path: nothing is read or written. What can't be read becomes problem(), and the
    // preferences are those of a first time.
    explicit PreferencesFile(const std::filesystem::path& path);

    Preferences now;

    // Writes them where they have changed. After the first time that this fails, which becomes
    // problem(), never again.
    void keep();

    // One line; empty: all is well.
    const std::string& problem() const { return problem_; }

private:
    std::filesystem::path path_;
    Preferences kept_;
    std::string problem_;
};

}  // namespace benchmarks
