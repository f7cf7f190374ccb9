#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace engine {
struct Constant;
struct ShaderExtension;
}  // namespace engine

// GLSL functions that a scene supplies: docs/extending.md.
namespace hair {

enum class ExtensionKind {
    shading,  // /shading/model
    offset,  // /strands/offset_function
    force,  // /simulation/force
    solver,  // /simulation/solver
    curve,  // /strands/curve
};

inline constexpr std::size_t kLargestExtension = std::size_t{64} << 10;  // B
inline constexpr std::size_t kMostExtensionParameters = 16;
// A parameter by which a solver's file chooses /simulation/substeps, s.
inline constexpr const char* kLongestSubstep = "longest_substep";

// A number or vector that the file declares. The file's functions read it as a constant of that
// name.
struct ExtensionParameter {
    std::string name;
    bool is_vector = false;
    glm::vec3 original{0.0f};  // used if the scene sets none; x of a number
    double minimum = 0.0;  // inclusive; per component of a vector
    double maximum = 0.0;  // inclusive
    std::string unit;
    std::string help;
};

// A parsed file.
struct Extension {
    ExtensionKind kind = ExtensionKind::shading;
    std::string text;  // of the file
    std::vector<ExtensionParameter> parameters;
    std::shared_ptr<const engine::ShaderExtension> shader;  // its text, with loops that end
};

// Parses a file's text. `name`: the file's name in errors. Throws engine::Error "<name>:<line>:
// <reason>" for a malformed declaration and for text that extensions must not contain. Does not
// compile the functions.
Extension parseExtension(ExtensionKind kind, const std::string& name, const std::string& text);

// A scene's value for a parameter of the file.
struct ExtensionValue {
    std::string name;
    bool is_vector = false;
    glm::vec3 value{0.0f};  // x of a number

    bool operator==(const ExtensionValue&) const = default;
};

struct ExtensionParameters {
    // After the file was read: all parameters of the file, in its order.
    std::vector<ExtensionValue> values;
    std::shared_ptr<const Extension> file;  // null: none, or not read yet

    // Compares values only: equal settings in the same folder name the same file.
    bool operator==(const ExtensionParameters& other) const { return values == other.values; }
};

// Extensions and constants for pipelines of shaders that call the file's functions; empty without a
// file.
std::vector<std::shared_ptr<const engine::ShaderExtension>>
shaderExtensions(const ExtensionParameters& parameters);
std::vector<engine::Constant> extensionConstants(const ExtensionParameters& parameters);

// Returns the value of a number parameter; 0 without a file or without the parameter.
float extensionNumber(const ExtensionParameters& parameters, const char* name);

}  // namespace hair
