#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace engine {

using ShaderCode = std::vector<std::uint32_t>;  // SPIR-V

// The code that pipelines are made of: what was compiled into the program (engine/shader_code.h),
// or what took its place since.
class ShaderLibrary {
public:
    // By entry point, "simulation/wind.comp".
    using Replacements = std::map<std::string, ShaderCode, std::less<>>;

    // Stays valid until replace(). An unknown path throws Error and lists the known ones.
    std::span<const std::uint32_t> code(std::string_view path) const;

    // These and no others are replaced from now on. Pipelines that exist keep their code.
    void replace(Replacements replacements) { replacements_ = std::move(replacements); }
    const Replacements& replacements() const { return replacements_; }

private:
    Replacements replacements_;
};

}  // namespace engine
