#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace benchmarks {

// Whether a library of this path is a Vulkan layer, by the names that layers' libraries have.
bool isLayerLibrary(std::string_view path);

// File names of the Vulkan layers in this process, explicit and implicit: the loader does not tell
// which are active, but it loads the libraries of those alone.
std::vector<std::string> loadedLayers();

}  // namespace benchmarks
