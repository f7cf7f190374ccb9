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

// Shaders that are compiled and drawn with as soon as they are saved.
namespace benchmarks::viewer {

// What a compiler says of a shader.
struct ShaderProblem {
    std::string file;  // relative to the folder of shaders; empty where it is no single file's
    int line = 0;      // from 1; 0: of no line
    std::string text;
    std::string source;  // the line as it was compiled
};

// Shaders that took the place of others.
struct ReloadedShaders {
    std::vector<std::string> paths;  // entry points that were compiled
    double seconds = 0;              // until pipelines were made of them
    std::chrono::system_clock::time_point when;
};

// What is known of shaders that are watched: a value.
struct ShaderStatus {
    bool watches = false;  // whether the folder has shaders of the program
    std::filesystem::path folder;
    std::vector<ShaderProblem> problems;  // of what was compiled last
    std::vector<std::string> changed;  // files that differ from what the program was built with
    ReloadedShaders reloaded;  // what was taken last
    std::vector<std::string> replaced;  // shaders that are not those of the build
};

// Watches the GLSL that the program was built from and compiles what was saved since, in process.
// Pipelines that are made from then on have the new code: that of all files that were saved, or,
// while one of them does not compile, of none.
class ShaderReload {
public:
    // `folder` is a copy of shaders/. Nothing is watched where it does not exist.
    ShaderReload(const engine::Device& device, const std::filesystem::path& folder);
    ~ShaderReload();
    ShaderReload(const ShaderReload&) = delete;
    ShaderReload& operator=(const ShaderReload&) = delete;

    // Looks at the files, at most a few times a second. True where new code compiled: then all
    // pipelines have to be made anew, and accept() or reject() says how that went.
    bool poll();
    // The new code stays.
    void accept();
    // The code before comes back; `reason` is a problem of the shaders that were new.
    void reject(const std::string& reason);

    // What is wrong with what was compiled last; empty: nothing.
    const std::vector<ShaderProblem>& problems() const;
    // Files that differ from what the program was built with, relative to the folder.
    const std::vector<std::string>& changed() const;
    // Whether C++ includes a file too. It is compiled as the program was built with it, whatever it
    // says now, for buffers are laid out so.
    static bool needsRebuild(std::string_view file) { return file.starts_with("shared/"); }
    // What accept() took last; it has no paths where that is nothing.
    const ReloadedShaders& reloaded() const;
    // Whether the folder has shaders of the program.
    bool watches() const;
    const std::filesystem::path& folder() const;
    // All of this.
    ShaderStatus status() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// What was reloaded and what the compiler says, within the current window of Dear ImGui.
void shaderPanel(const ShaderStatus& status);

// The texts of files that others write. Editors save in steps (truncate, then write; or write
// beside, then rename), so that a file may be gone, empty or cut short for a moment: it counts as
// changed only once it looks the same at two looks running.
class WatchedFiles {
public:
    using Text = std::optional<std::string>;  // none: there is no such file

    explicit WatchedFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Watches a file. It counts as having `text` until a look finds another.
    void watch(const std::string& file, Text text);
    // A file's text. A file that isn't watched yet is read, and watched from now on.
    const Text& text(const std::string& file);

    // Looks at the files on disk. True where a text became another.
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
        std::optional<Stamp> read;  // when `text` was read; none: never
        std::optional<Stamp> seen;  // at the last look
    };

    Stamp stampOf(const std::string& file) const;
    Text read(const std::string& file) const;

    std::filesystem::path folder_;
    std::map<std::string, File, std::less<>> files_;
};

}  // namespace benchmarks::viewer
