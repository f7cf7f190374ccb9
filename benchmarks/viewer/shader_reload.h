#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/device.h"

// Compiles shaders when they are saved, and draws with them.
namespace benchmarks::viewer {

// A compiler's message about a shader.
struct ShaderProblem {
    std::string file;  // relative to the folder of shaders; empty if it concerns no single file
    int line = 0;  // from 1; 0: no line
    std::string text;
    std::string source;  // the compiled line
};

// Reloaded shaders.
struct ReloadedShaders {
    std::vector<std::string> paths;  // compiled entry points
    double seconds = 0;  // until their pipelines were created
    std::chrono::system_clock::time_point when;
};

// State of the watched shaders, as plain values.
struct ShaderStatus {
    bool watches = false;  // whether the folder has the program's shaders
    std::filesystem::path folder;
    std::vector<ShaderProblem> problems;  // from the last compilation
    std::vector<std::string> changed;  // files that differ from those of the build
    ReloadedShaders reloaded;  // last accepted shaders
    std::vector<std::string> replaced;  // shaders that differ from the build's
};

// Watches the GLSL sources of the program and compiles saved changes in process. New pipelines then
// have the code of all saved files, or of none while one of them does not compile.
class ShaderReload {
public:
    // `folder` is a copy of shaders/. If it does not exist, nothing is watched.
    ShaderReload(const engine::Device& device, const std::filesystem::path& folder);
    ~ShaderReload();
    ShaderReload(const ShaderReload&) = delete;
    ShaderReload& operator=(const ShaderReload&) = delete;

    // Checks the files, at most a few times a second. Returns true if new code was compiled. The
    // caller then recreates all pipelines and calls accept() or reject().
    bool poll();
    // Keeps the new code.
    void accept();
    // Restores the previous code; `reason` becomes a problem of the new shaders.
    void reject(const std::string& reason);

    // Problems of the last compilation; empty if there are none.
    const std::vector<ShaderProblem>& problems() const;
    // Files that differ from those of the build, relative to the folder.
    const std::vector<std::string>& changed() const;
    // Whether C++ also includes the file. It is always compiled as in the build, because C++ has
    // that buffer layout.
    static bool needsRebuild(std::string_view file) { return file.starts_with("shared/"); }
    // The last code that accept() accepted; without paths if there is none.
    const ReloadedShaders& reloaded() const;
    // Whether the folder has the program's shaders.
    bool watches() const;
    const std::filesystem::path& folder() const;
    // Returns all of this.
    ShaderStatus status() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// Shows reloaded shaders and compiler messages within the current Dear ImGui window.
void shaderPanel(const ShaderStatus& status);

// Texts of files that other programs write. Editors save in steps (truncate, then write; or write a
// copy, then rename), so a file may be missing, empty or incomplete for a moment. A file counts as
// changed only when two successive checks find the same state.
class WatchedFiles {
public:
    using Text = std::optional<std::string>;  // absent: the file does not exist

    explicit WatchedFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Watches a file. It counts as having `text` until a check finds another.
    void watch(const std::string& file, Text text);
    // Returns a file's text. Reads a file that is not watched yet, and watches it from then on.
    const Text& text(const std::string& file);

    // Checks the files on disk. Returns true if a text changed.
    bool look();

    const std::filesystem::path& folder() const { return folder_; }

private:
    struct Stamp {
        bool exists = false;
        std::filesystem::file_time_type time{};
        std::uintmax_t size = 0;

        bool operator==(const Stamp&) const = default;
    };
    struct File {
        Text text;
        std::optional<Stamp> read;  // when `text` was read; absent: never
        std::optional<Stamp> seen;  // at the last check
    };

    Stamp stampOf(const std::string& file) const;
    Text read(const std::string& file) const;

    std::filesystem::path folder_;
    std::map<std::string, File, std::less<>> files_;
};

}  // namespace benchmarks::viewer
