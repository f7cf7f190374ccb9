#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace benchmarks {

// Asks for the path of a file to write, over everything else.
class PathPopup {
public:
    // From the next picture of the window on, with a path to begin with.
    void open(const std::filesystem::path& suggested);

    // Shows it while it is open; the path that was accepted.
    std::optional<std::filesystem::path> show();

private:
    std::string typed_;
    bool opens_ = false;
};

}  // namespace benchmarks
