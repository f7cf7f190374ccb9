#include "benchmarks/viewer/timings/changed_shaders.h"

#include <string>

#include "engine/shader_library.h"

namespace benchmarks {

void warnOfChangedShaders(const engine::Device& device, Trust& trust) {
    std::string names;
    for (const auto& [path, code] : device.shaders().replacements())
        names += (names.empty() ? "" : ", ") + path;
    if (names.empty()) return;
    trust.warnings.push_back("shaders that are not those of the build: " + names);
}

}  // namespace benchmarks
