#include "benchmarks/reference_tool.h"

#include <cstdlib>
#include <system_error>

#include "benchmarks/interrupt.h"
#include "engine/error.h"
#include "hair/groom/formats/run_tool.h"

namespace benchmarks {
namespace {

std::string interpreter() {
    const char* wanted = std::getenv("HAIRBENCH_REFERENCE_PYTHON");
    return wanted && *wanted ? wanted : HAIRBENCH_SOURCE_DIR "/.deps/reference/bin/python";
}

void run(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line) {
    // -B -E: leaves no byte code beside the tool, and nobody's variables change what it does.
    std::vector<std::string> all{interpreter(), "-B", "-E"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    try {
        hair::runTool(all, each_line, checkInterrupted);
    } catch (const std::system_error& error) {
        throw engine::Error(
            "this needs the project's Python environment for references: run scripts/setup "
            "--reference (" +
            std::string(error.what()) + ')');
    } catch (const engine::Error&) {
        checkInterrupted();  // which ends the tool too
        throw;
    }
}

}  // namespace

void runReferenceTool(
    const std::string& script, const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line) {
    std::vector<std::string> all{HAIRBENCH_SOURCE_DIR "/benchmarks/reference/" + script};
    all.insert(all.end(), arguments.begin(), arguments.end());
    run(all, each_line);
}

void checkReferenceTool() {
    run({"-c", "import mitsuba"}, [](std::string_view) {});
}

}  // namespace benchmarks
