#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/device.h"

namespace benchmarks {

// What a compiler says of a shader.
struct ShaderProblem {
    std::string file;  // relative to the folder of shaders; may be empty: of no single one
    int line = 0;      // from 1; 0: of no line
    std::string text;
    std::string source;  // that line, as it was compiled
};

// Shaders that took the place of others.
struct ReloadedShaders {
    std::vector<std::string> paths;  // of entry points
    double seconds = 0;              // until pipelines were made of them
    std::chrono::system_clock::time_point when;
};

// Watches the GLSL that the program was built from and compiles what was saved since, in process.
// Pipelines that are made from then on have the new code: that of all files that were saved, or,
// while one of them does not compile, of none.
class ShaderReload {
public:
    // `folder` is a copy of shaders/; one that does not exist is watched for nothing.
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

    // Of what was compiled last; empty: all is well.
    const std::vector<ShaderProblem>& problems() const;
    // Files that differ from what the program was built with, relative to the folder.
    const std::vector<std::string>& changed() const;
    // Those that C++ has too: they are compiled as the program was built with them, whatever they
    // say now, for buffers are laid out so.
    static bool needsRebuild(std::string_view file) { return file.starts_with("shared/"); }
    // What accept() took last; without paths: nothing yet.
    const ReloadedShaders& reloaded() const;
    // Whether the folder has shaders of the program.
    bool watches() const;
    const std::filesystem::path& folder() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace benchmarks
