#pragma once

#include <filesystem>
#include <string>

#include "hair/settings.h"

namespace benchmarks {

// The settings with file names that were relative to `from` and are now to `to`. Empty and absolute
// names stay as they are.
hair::Settings movedFiles(
    hair::Settings settings, const std::filesystem::path& from, const std::filesystem::path& to);

// The scene that has these settings and no sweep: JSON text, for a file in the folder `to`, of what
// differs from the defaults. It reads back bit-equal.
std::string sceneText(
    const hair::Settings& settings, const std::filesystem::path& from,
    const std::filesystem::path& to);

// Writes it in one step. Throws engine::Error "<path>: <reason>".
void saveScene(
    const hair::Settings& settings, const std::filesystem::path& from,
    const std::filesystem::path& file);

}  // namespace benchmarks
