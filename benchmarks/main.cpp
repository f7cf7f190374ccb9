#include <exception>
#include <iostream>

#include "benchmarks/commands/command_line.h"
#include "benchmarks/report/change.h"
#include "engine/error.h"
#include "engine/instance.h"

using namespace benchmarks;

int main(int argc, char** argv) {
    try {
        return commands::runCommandLine(argc, argv);
    } catch (const engine::NoDevice& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return report::kNoDevice;
    } catch (const engine::Error& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return report::kUsageError;
    } catch (const std::exception& error) {
        std::cerr << "hairbench: internal error: " << error.what() << '\n';
        return report::kInternalError;
    }
}
