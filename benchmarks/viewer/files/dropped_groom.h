#pragma once

#include <filesystem>
#include <string>

#include "hair/settings.h"

namespace benchmarks {

// Settings whose hair is that of a file, without what belonged to the hair before: its style, its
// placement and the hands that pull at it.
//   - Where the file doesn't state its unit, it is guessed as `groom info` does.
//   - Of more than 1,000 strands 300 become guides, and all are drawn, each moved by three of them.
//   - The mesh stays where the roots are on it (three quarters of them within 1 cm); otherwise it
//     goes, with the bodies that follow it, and the strands float.
// `name` is what the settings call the file; other names in them are relative to `directory`.
// Throws engine::Error that names a file.
hair::Settings withGroom(
    hair::Settings settings, const std::filesystem::path& directory,
    const std::filesystem::path& file, const std::string& name);

}  // namespace benchmarks
