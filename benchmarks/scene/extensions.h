#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/scene/reach.h"
#include "hair/extension.h"
#include "hair/settings.h"

// GLSL files that scenes name: docs/extending.md.
namespace benchmarks::scene {

// A field that may name a GLSL file, and the field of its parameters.
struct ExtensionField {
    hair::ExtensionKind kind;
    const char* pointer;
    const char* parameters;
};

inline constexpr ExtensionField kExtensionFields[]{
    {hair::ExtensionKind::shading, "/shading/model", "/shading/model_parameters"},
    {hair::ExtensionKind::offset, "/strands/offset_function", "/strands/offset_parameters"},
    {hair::ExtensionKind::force, "/simulation/force", "/simulation/force_parameters"}};

// Treatment of parameters that the file does not declare.
enum class UnknownParameters { refused, dropped };

// Reads the files that the settings name, and completes and checks their parameters. Names are
// relative to `directory`. Throws engine::Error "<JSON pointer>: <reason>" for a file that cannot
// be read or is out of reach, and for parameters that it does not declare.
void loadExtensions(
    hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach = {},
    UnknownParameters unknown = UnknownParameters::refused);

// Returns the settings with their files read.
hair::Settings
withExtensions(const hair::Settings& settings, const std::filesystem::path& directory);

// Reads the files again and drops parameters that they no longer have. If that fails, leaves the
// settings unchanged; playing them then reports the error.
void rereadExtensions(hair::Settings& settings, const std::filesystem::path& directory);

// Compiles the files for every stage that calls them, to find errors. Throws engine::Error "<JSON
// pointer>: <file>:<line>: <reason>".
void checkExtensions(const hair::Settings& settings);

// A GLSL file that was read.
struct NamedExtension {
    std::string pointer;  // of the field that names it
    std::string file;  // as the field names it
    std::string text;
};
std::vector<NamedExtension> namedExtensions(const hair::Settings& settings);

}  // namespace benchmarks::scene
