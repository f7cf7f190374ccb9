#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/scene/reach.h"
#include "hair/extension.h"
#include "hair/settings.h"

// Files of GLSL that scenes name: docs/extending_scenes.md.
namespace benchmarks::scene {

// A field that may name one, and the one of its parameters.
struct ExtensionField {
    hair::ExtensionKind kind;
    const char* pointer;
    const char* parameters;
};

inline constexpr ExtensionField kExtensionFields[]{
    {hair::ExtensionKind::shading, "/shading/model", "/shading/model_parameters"},
    {hair::ExtensionKind::offset, "/strands/offset_function", "/strands/offset_parameters"},
    {hair::ExtensionKind::force, "/simulation/force", "/simulation/force_parameters"}};

// Parameters that the file does not declare.
enum class UnknownParameters { refused, dropped };

// Reads the files that the settings name, and completes and checks their parameters. `directory` is
// what names are relative to. Throws engine::Error "<JSON pointer>: <reason>" for a file that can't
// be read, or is out of reach, and for parameters that are not its own.
void loadExtensions(
    hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach = {},
    UnknownParameters unknown = UnknownParameters::refused);

// The settings with their files read.
hair::Settings
withExtensions(const hair::Settings& settings, const std::filesystem::path& directory);

// Reads them anew, where that is possible, and drops parameters that they don't have. Others stay
// as they are, and whoever plays them hears why.
void rereadExtensions(hair::Settings& settings, const std::filesystem::path& directory);

// Compiles the files, for the errors. Throws engine::Error "<JSON pointer>: <file>:<line>:
// <reason>".
void checkExtensions(const hair::Settings& settings);

// A file that was read.
struct NamedExtension {
    std::string pointer;  // of the field that names it
    std::string file;  // as the field has it
    std::string text;
};
std::vector<NamedExtension> namedExtensions(const hair::Settings& settings);

}  // namespace benchmarks::scene
