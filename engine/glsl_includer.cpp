#include "engine/glsl_includer.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace engine {

namespace {

constexpr std::string_view kFolder = "./";

}  // namespace

std::string nameForGlslang(const std::string& file) { return std::string(kFolder) + file; }

std::string fileOfGlslangName(const std::string& name) {
    return name.starts_with(kFolder) ? name.substr(kFolder.size()) : name;
}

GlslIncluder::IncludeResult*
GlslIncluder::includeSystem(const char* header_name, const char*, std::size_t) {
    const std::string file = header_name;
    if (std::ranges::find(files_, file) == files_.end()) files_.push_back(file);
    const std::string name = nameForGlslang(file);
    // Once within itself is what include guards are for; twice, it has none and never ends.
    const auto within = std::ranges::count_if(
        open_, [&](const auto& open) { return open->result->headerName == name; });
    if (within > 1) return open("", "the file includes itself without end");
    std::optional<std::string> text = read_(file);
    if (!text) return open("", "there is no such file in the folder of shaders");
    return open(name, std::move(*text));
}

GlslIncluder::IncludeResult* GlslIncluder::open(std::string name, std::string text) {
    auto opened = std::make_unique<Open>();
    opened->text = std::move(text);
    opened->result = std::make_unique<IncludeResult>(
        std::move(name), opened->text.data(), opened->text.size(), nullptr);
    open_.push_back(std::move(opened));
    return open_.back()->result.get();
}

void GlslIncluder::releaseInclude(IncludeResult* result) {
    std::erase_if(open_, [&](const auto& open) { return open->result.get() == result; });
}

}  // namespace engine
