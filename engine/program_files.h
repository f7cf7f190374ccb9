#pragma once

#include <filesystem>
#include <string>
#include <string_view>

// Where the program's own files lie. They are found from where the program itself lies, so that an
// installed tree may be moved and no program knows the machine that built it:
//
//   installed                          in a build tree
//   <prefix>/bin/hairbench             <build>/benchmarks/hairbench, <build>/tests/test_*
//   <prefix>/share/hairbench/          <build>/share/hairbench, a link to the source tree
//   <prefix>/libexec/hairbench/        <build>/libexec/hairbench/
namespace engine {

// A file or folder that comes with the program, by its name in the source tree: "scenes",
// "benchmarks/report/page/page.css". Links are followed. It need not be there.
std::filesystem::path programFile(std::string_view name);

// A program that this one runs. It need not be there.
std::filesystem::path helperProgram(std::string_view name);

// The folder of a Python environment of the project, "python" or "reference": in .deps
// of the source tree, or where that has none in the user's own data ($XDG_DATA_HOME/hairbench or
// ~/.local/share/hairbench). It need not be there.
std::filesystem::path pythonEnvironment(const std::string& name);

// Its interpreter, or the one that the variable `override` of the environment names.
std::string pythonInterpreter(const std::string& name, const char* override);

// What makes it: "scripts/setup --python", or an installed program's own script.
std::string makesPythonEnvironment(const std::string& name);

}  // namespace engine
