#include "hair/groom/formats/import_usd.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "engine/error.h"
#include "hair/groom/formats/run_tool.h"
#include "hair/groom/formats/usd_stream.h"

namespace hair {
namespace {

constexpr const char* kTool = HAIRBENCH_SOURCE_DIR "/hair/groom/formats/usd_curves.py";
constexpr const char* kInterpreter = HAIRBENCH_SOURCE_DIR "/.deps/python/bin/python";

std::vector<std::byte> readStage(const std::filesystem::path& path) {
    const char* wanted = std::getenv("HAIRBENCH_PYTHON");
    const std::string interpreter = wanted && *wanted ? wanted : kInterpreter;
    try {
        // -B -E: leaves no byte code beside the tool, and nobody's variables change what it does.
        // An absolute path, which is no option whatever it begins with.
        return runTool({interpreter, "-B", "-E", kTool, std::filesystem::absolute(path).string()});
    } catch (const std::system_error& error) {
        throw engine::Error(
            "reading USD needs the project's Python environment: run scripts/setup --python (" +
            std::string(error.what()) + ')');
    }
}

}  // namespace

StrandSet importUsd(const StrandFile& file) {
    if (file.path.empty())
        throw engine::Error("USD can be read from a file alone, not from memory");
    const std::vector<std::byte> bytes = readStage(file.path);
    try {
        return readUsdStream(bytes);
    } catch (const engine::Error& error) {
        throw engine::Error(std::string("what usd_curves.py wrote: ") + error.what());
    }
}

}  // namespace hair
