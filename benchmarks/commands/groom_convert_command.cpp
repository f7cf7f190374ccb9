#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/convert.h"
#include "benchmarks/report/change.h"
#include "engine/process.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {

int convertGroom(const groom::ConvertOptions& options) {
    const groom::ConvertLog log{
        .say =
            [](const std::string& line) {
                std::cout << engine::shownText(line) << std::endl;  // flushes early
            },
        .warn =
            [](const std::filesystem::path& file, const std::string& warning) {
                std::cerr << "hairbench: " << engine::shownText(file.string() + ": " + warning)
                          << '\n';
            }};
    try {
        groom::convert(options, log);
    } catch (const engine::Interrupted&) {
        std::cerr << "hairbench: interrupted, " << options.out.string() << " is not written\n";
        return report::kInterrupted;
    }
    return report::kOk;
}

}  // namespace benchmarks::commands
