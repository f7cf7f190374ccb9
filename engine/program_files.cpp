#include "engine/program_files.h"

#include <cstdlib>
#include <system_error>

namespace engine {
namespace {

namespace fs = std::filesystem;

// Returns the parent of the program's folder.
fs::path prefix() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return program.parent_path().parent_path();
}

fs::path userDataFolder() {
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data)
        return fs::path(data) / "hairbench";
    if (const char* home = std::getenv("HOME"); home && *home)
        return fs::path(home) / ".local/share/hairbench";
    return {};
}

// A script that is installed with the program; in the source tree, scripts/setup runs it.
constexpr const char* kMaker = "python-environment";

}  // namespace

fs::path programFile(std::string_view name) {
    std::error_code error;
    const fs::path file = prefix() / "share/hairbench" / name;
    const fs::path place = fs::weakly_canonical(file, error);
    return error ? file : place;
}

fs::path helperProgram(std::string_view name) { return prefix() / "libexec/hairbench" / name; }

fs::path pythonEnvironment(const std::string& name) {
    std::error_code error;
    const fs::path made = programFile(".deps") / name;
    const fs::path users = userDataFolder();
    return users.empty() || fs::exists(made, error) ? made : users / name;
}

std::string pythonInterpreter(const std::string& name, const char* override) {
    const char* const wanted = std::getenv(override);
    return wanted && *wanted ? wanted : (pythonEnvironment(name) / "bin/python").string();
}

std::string makesPythonEnvironment(const std::string& name) {
    std::error_code error;
    const fs::path maker = helperProgram(kMaker);
    return fs::exists(maker, error) ? maker.string() + ' ' + name : "scripts/setup --" + name;
}

}  // namespace engine
