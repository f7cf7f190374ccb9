#include "benchmarks/gate/block_runner.h"

#include <system_error>
#include <utility>

#include "benchmarks/exit_codes.h"
#include "benchmarks/gate/child_process.h"
#include "engine/error.h"
#include "engine/read_file.h"

namespace benchmarks {

namespace {

constexpr std::size_t kMostLines = 12;  // of a failed process that are shown
constexpr std::size_t kMostBytes = 4000;

std::string lastLines(const std::filesystem::path& file) {
    std::string text;
    try {
        text = engine::readFile(file);
    } catch (const engine::Error&) {
        return {};  // it could not even be started
    }
    while (text.ends_with('\n')) text.pop_back();
    std::size_t begin = text.size();
    for (std::size_t line = 0; line < kMostLines && begin != std::string::npos && begin > 0; ++line)
        begin = text.rfind('\n', begin - 1);
    if (begin != std::string::npos && begin > 0) text.erase(0, begin + 1);
    if (text.size() > kMostBytes) text.erase(0, text.size() - kMostBytes);
    return text;
}

int exitStatusFor(int status) {
    const bool passes_on = status == kNoDevice || status == kUsageError || status == kNothingRan;
    return passes_on ? status : kInternalError;
}

// Runs of which every case was skipped or failed write a report too.
bool wroteReport(const ChildEnd& end) {
    return !end.signaled && (end.status == kOk || end.status == kNothingRan);
}

std::string failureText(const Side& side, const ChildEnd& end, const std::filesystem::path& log) {
    std::string text{side.name};
    text += " (" + side.text + ") ";
    text += end.signaled ? "was ended by signal " + std::to_string(end.status - 128)
                         : "ended with status " + std::to_string(end.status);
    if (end.status == 127 && !end.signaled) text += ": no such program";
    const std::string said = lastLines(log);
    return said.empty() ? text : text + ":\n" + said;
}

}  // namespace

BlockReport BlockRunner::run(const Side& side, std::uint32_t seed) {
    namespace fs = std::filesystem;
    const fs::path folder = scratch_.path() / "block";
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    fs::create_directories(folder);
    const fs::path report = folder / "report.json";
    const fs::path log = folder / "output.txt";
    const ChildEnd end = runChild(blockCommand(side, scene_, report, seed), log);
    if (!wroteReport(end))
        throw BlockFailed(failureText(side, end, log), exitStatusFor(end.status));
    try {
        return readBlock(report);
    } catch (const engine::Error& error) {
        std::string text = std::string{side.name} + " (" + side.text + ") left no report: ";
        text += error.what();
        if (const std::string said = lastLines(log); !said.empty()) text += '\n' + said;
        throw BlockFailed(text, end.status == kOk ? kUsageError : end.status);
    }
}

}  // namespace benchmarks
