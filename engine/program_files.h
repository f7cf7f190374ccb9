#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// Places of the program's own files, relative to the program itself. So an installed tree can be
// moved, and no program depends on the machine that built it:
//
//   installed                          in a build tree
//   <prefix>/bin/hairbench             <build>/benchmarks/hairbench, <build>/tests/test_*
//   <prefix>/share/hairbench/          <build>/share/hairbench, a link to the source tree
//   <prefix>/libexec/hairbench/        <build>/libexec/hairbench/
namespace engine {

// Returns a file or folder that comes with the program, by its name in the source tree: "scenes",
// "benchmarks/report/page/page.css". Follows links. It need not exist.
std::filesystem::path programFile(std::string_view name);

// Returns a helper program that this program runs. It need not exist.
std::filesystem::path helperProgram(std::string_view name);

// Returns the folder of one of the project's Python environments, "python" or "reference": in .deps
// of the source tree, or else in the user's data folder ($XDG_DATA_HOME/hairbench or
// ~/.local/share/hairbench). It need not exist.
std::filesystem::path pythonEnvironment(const std::string& name);

// Returns its interpreter, or the interpreter named by the environment variable `override`.
std::string pythonInterpreter(const std::string& name, const char* override);

// Returns the command that makes it: "scripts/setup --python", or an installed script.
std::string makesPythonEnvironment(const std::string& name);

}  // namespace engine
