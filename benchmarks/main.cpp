#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "benchmarks/commands/command_line.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/instance.h"
#include "engine/system/process.h"

using namespace benchmarks;

namespace {

int fail(std::string_view kind, const std::string& reason, int status) {
    std::cerr << "hairbench: " << kind << reason << '\n';
    return status;
}

int statusOf(int argc, char** argv) {
    try {
        return commands::runCommandLine(argc, argv);
    } catch (const engine::WriteFailed& error) {
        return fail("", commands::shortMessage(error), report::kInternalError);
    } catch (const engine::NoDevice& error) {
        return fail("", commands::shortMessage(error), report::kNoDevice);
    } catch (const engine::Error& error) {
        return fail("", commands::shortMessage(error), report::kUsageError);
    } catch (const std::filesystem::filesystem_error& error) {
        const std::string path = error.path1().string();
        return fail(
            "", commands::shortMessage(engine::Error(path, error.code().message())),
            report::kUsageError);
    } catch (const std::bad_alloc&) {
        return fail("", "not enough memory", report::kInternalError);
    } catch (const std::system_error& error) {  // e.g. a thread that could not be started
        return fail(
            "",
            "the system has no more memory, threads or files for it: " + error.code().message() +
                " (see ulimit)",
            report::kInternalError);
    } catch (const std::exception& error) {
        return fail("internal error: ", commands::shortMessage(error), report::kInternalError);
    }
}

}  // namespace

int main(int argc, char** argv) {
    engine::system::prepareStreams();
    const int status = statusOf(argc, argv);
    std::cout.flush();
    // Another thread's flush may have failed; then only the file has the error.
    if (std::cout && std::ferror(stdout) == 0) return status;
    return fail(
        "", "standard output can't be written",
        status == report::kOk ? report::kInternalError : status);
}
