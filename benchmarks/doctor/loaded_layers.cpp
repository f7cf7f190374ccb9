#include "benchmarks/doctor/loaded_layers.h"

#include <algorithm>
#include <array>

#include <link.h>

namespace benchmarks {

namespace {

// Most follow the convention of the first; the others are widely installed and do not.
constexpr std::array<std::string_view, 6> kMarks{"VkLayer",   "vkLayer",  "MangoHud",
                                                 "renderdoc", "vkbasalt", "overlayvulkanlayer"};

std::string_view fileName(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

int collect(dl_phdr_info* library, std::size_t, void* data) {
    if (isLayerLibrary(library->dlpi_name)) {
        static_cast<std::vector<std::string>*>(data)->emplace_back(fileName(library->dlpi_name));
    }
    return 0;
}

}  // namespace

bool isLayerLibrary(std::string_view path) {
    const std::string_view name = fileName(path);
    return std::ranges::any_of(
        kMarks, [&](std::string_view mark) { return name.find(mark) != std::string_view::npos; });
}

std::vector<std::string> loadedLayers() {
    std::vector<std::string> layers;
    dl_iterate_phdr(collect, &layers);
    return layers;
}

}  // namespace benchmarks
