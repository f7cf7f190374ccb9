#include "engine/run_tool.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <span>
#include <thread>

#include "engine/error.h"
#include "engine/process.h"

namespace engine {
namespace {

using system::ChildEnd;
using system::Poll;
using system::Take;

constexpr std::size_t kLongestLine = 300;  // bytes

std::string lastLine(std::string_view text) {
    while (text.ends_with('\n')) text.remove_suffix(1);
    const std::string_view line = text.substr(text.rfind('\n') + 1);
    std::string shown(line.substr(0, kLongestLine));
    if (line.size() > kLongestLine) shown += " [...]";
    return shown;
}

std::string describe(const ChildEnd& end, const ChildLimits& limits) {
    if (end.out_of_memory)
        return "needed more than " + std::to_string(limits.bytes >> 20) + " MiB of memory";
    if (end.out_of_time && limits.seconds > 0)
        return "needed more than " + std::to_string(limits.seconds) + " s of CPU time";
    return (end.signaled ? "ended by signal " : "ended with status ") + std::to_string(end.status);
}

bool succeeded(const ChildEnd& end) { return !end.signaled && end.status == 0; }

// Returns a poll that calls `poll`, and throws when the child has used up its wall-clock time.
Poll timed(const ChildLimits& limits, const std::string& prefix, const Poll& poll) {
    if (limits.seconds == 0) return poll;
    const std::chrono::seconds most(60 + 10 * std::uint64_t{limits.seconds});
    const auto end = std::chrono::steady_clock::now() + most;
    return [=] {
        if (poll) poll();
        if (std::chrono::steady_clock::now() > end)
            throw Error(prefix + "not finished after " + std::to_string(most.count()) + " s");
    };
}

void run(
    const std::vector<std::string>& arguments, const ChildLimits& limits, const Take& take,
    const Poll& poll = {}) {
    const std::string& program = arguments.front();
    std::string errors;
    const ChildEnd end =
        system::runChild(arguments, limits, take, timed(limits, program + " was ", poll), errors);
    checkInterrupted();  // a terminal's interrupt also ends the child
    if (succeeded(end)) return;
    const std::string line = end.signaled || end.out_of_time ? "" : lastLine(errors);
    throw Error(!line.empty() ? line : program + " " + describe(end, limits));
}

}  // namespace

std::string runApart(const std::function<std::string()>& work, const ChildLimits& limits) {
    std::string bytes;
    const Take take = [&](std::span<const char> part) {
        if (part.size() > limits.output - bytes.size())
            throw Error("wrote more than " + std::to_string(limits.output) + " bytes");
        bytes.append(part.data(), part.size());
    };
    const ChildEnd end = system::runFork(work, limits, take, timed(limits, "", checkInterrupted));
    checkInterrupted();
    if (succeeded(end)) return bytes;
    throw Error(describe(end, limits));
}

std::vector<std::byte>
runTool(const std::vector<std::string>& arguments, const ChildLimits& limits) {
    std::vector<std::byte> bytes;
    const Take take = [&](std::span<const char> part) {
        checkInterrupted();
        if (part.size() > limits.output - bytes.size())
            throw Error(
                arguments.front() + " wrote more than " + std::to_string(limits.output) + " bytes");
        const auto read = std::as_bytes(part);
        bytes.insert(bytes.end(), read.begin(), read.end());
    };
    run(arguments, limits, take, checkInterrupted);
    return bytes;
}

void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll) {
    std::string rest;
    run(
        arguments, {},
        [&](std::span<const char> part) {
            rest.append(part.data(), part.size());
            std::size_t begin = 0;
            for (std::size_t end; (end = rest.find('\n', begin)) != std::string::npos;
                 begin = end + 1)
                each_line(std::string_view(rest).substr(begin, end - begin));
            rest.erase(0, begin);
        },
        poll);
    if (!rest.empty()) each_line(rest);
}

ProgramEnd runProgram(
    const std::vector<std::string>& command, const std::filesystem::path& output,
    const std::filesystem::path& temporary) {
    using Clock = std::chrono::steady_clock;
    // Polling costs microseconds, which is negligible for a long run, and a short run is not waited
    // for much longer than it takes.
    constexpr std::chrono::milliseconds kShortestLook{1}, kLongestLook{20};
    // A run that waits for its device ends within a second; this program should end within two.
    constexpr std::chrono::milliseconds kGrace{1700};

    system::Program program(command, output, temporary);
    std::optional<Clock::time_point> asked_to_end;
    Clock::duration look = kShortestLook;
    for (;;) {
        const std::optional<ChildEnd> end = program.end();
        if (asked_to_end && (end || Clock::now() > *asked_to_end + kGrace)) throw Interrupted();
        if (end && end->signaled) return {128 + end->status, true};
        if (end) return {end->status, false};
        if (interrupted() && !asked_to_end) {
            program.interrupt();
            asked_to_end = Clock::now();
        }
        std::this_thread::sleep_for(look);
        look = std::min<Clock::duration>(look * 5 / 4, kLongestLook);
    }
}

}  // namespace engine
