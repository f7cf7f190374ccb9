#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// Where scenes lie, and which files they may name: one that a stranger made ought to open none but
// its own.
namespace benchmarks::scene {

// The file that is meant by the name of a scene: the file of that name where there is one, else
// the scene of that name that comes with the program: "thesis", "scenes/thesis.json",
// "portraits/braid". The name as it is where there is neither.
std::filesystem::path sceneNamed(const std::filesystem::path& name);

// Names of the scenes that come with the program, as sceneNamed() takes them, in alphabetical
// order: "thesis", "portraits/braid".
std::vector<std::string> shippedScenes();

// What the user says of files outside: --allow-outside.
enum class Outside { refused, allowed };

// The folders that files named by a scene may lie in, after links are followed:
//   - the scene's own folder; where that or one above it holds scene.schema.json, the nearest that
//     does, so that the scenes of a folder may lie in folders of it and share assets
//   - the program's own scenes, on which others are built
class Reach {
public:
    // Everywhere.
    Reach() = default;
    // Of the file that the user opens. Those that it leads to, bases and members of a suite, have
    // the same reach.
    Reach(const std::filesystem::path& opened, Outside outside);

    // Throws engine::Error "<file>: <reason>" for one that lies elsewhere.
    void check(const std::filesystem::path& file) const;

    // The same for a file that `owner` names. Those beside the owner and in folders there are its
    // own, wherever it is.
    void check(const std::filesystem::path& file, const std::filesystem::path& owner) const;

private:
    std::vector<std::filesystem::path> folders_;  // canonical; empty: everywhere
};

// Every file that a value of the field at `pointer` names, or where that is empty a document, of a
// scene in `directory`. Throws engine::Error "<JSON pointer>: <file>: <reason>" for one out of
// reach.
void checkNamedFiles(
    const Json& value, const std::string& pointer, const std::filesystem::path& directory,
    const Reach& reach);

}  // namespace benchmarks::scene
