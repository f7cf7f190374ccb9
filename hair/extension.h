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

// Functions in GLSL that a scene brings along: docs/extending_scenes.md.
namespace hair {

enum class ExtensionKind {
    shading,  // /shading/model
    offset,  // /strands/offset_function
    force,  // /simulation/force
};

inline constexpr std::size_t kLargestExtension = std::size_t{64} << 10;  // B
inline constexpr std::size_t kMostExtensionParameters = 16;

// A number or vector that the file declares, and its functions read as a constant of that name.
struct ExtensionParameter {
    std::string name;
    bool is_vector = false;
    glm::vec3 original{0.0f};  // what it is where a scene says nothing; of a number x
    double minimum = 0.0;  // inclusive; of a vector for each component
    double maximum = 0.0;  // inclusive
    std::string unit;
    std::string help;
};

// A file, read.
struct Extension {
    ExtensionKind kind = ExtensionKind::shading;
    std::vector<ExtensionParameter> parameters;
    std::shared_ptr<const engine::ShaderExtension> shader;
};

// `name` is the file's, as errors have it. Throws engine::Error "<name>:<line>: <reason>" for a
// declaration that is none, and for what no extension may say. Functions are not compiled here.
Extension parseExtension(ExtensionKind kind, const std::string& name, std::string text);

// What a scene sets of a file's parameters.
struct ExtensionValue {
    std::string name;
    bool is_vector = false;
    glm::vec3 value{0.0f};  // of a number x

    bool operator==(const ExtensionValue&) const = default;
};

struct ExtensionParameters {
    // Once the file is read all of the file's parameters, in its order.
    std::vector<ExtensionValue> values;
    std::shared_ptr<const Extension> file;  // null: none, or not read yet

    // By values alone: of the same settings in the same folder the file is the same.
    bool operator==(const ExtensionParameters& other) const { return values == other.values; }
};

// What pipelines of the shaders that call the file's functions are made with; nothing without a
// file.
std::vector<std::shared_ptr<const engine::ShaderExtension>>
shaderExtensions(const ExtensionParameters& parameters);
std::vector<engine::Constant> extensionConstants(const ExtensionParameters& parameters);

// The value of a parameter that is a number; 0 without a file or such a parameter.
float extensionNumber(const ExtensionParameters& parameters, const char* name);

}  // namespace hair
