#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace benchmarks {

// A button that asks where a file is to go and writes it there, and what came of it.
class SaveBox {
public:
    explicit SaveBox(std::string button) : button_(std::move(button)) {}

    // Within the current window of Dear ImGui. `suggested` is asked for when the box opens; `write`
    // throws engine::Error.
    void show(
        const std::filesystem::path& suggested,
        const std::function<void(const std::filesystem::path&)>& write);

private:
    void save(const std::function<void(const std::filesystem::path&)>& write);

    std::string button_;
    std::string path_;
    std::string problem_;  // of the last try
    std::string told_;  // what was written
};

}  // namespace benchmarks
