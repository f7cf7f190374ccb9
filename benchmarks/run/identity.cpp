#include "benchmarks/run/identity.h"

#include "benchmarks/text_at.h"

namespace benchmarks {

namespace {

struct Member {
    const char* name;
    const char* pointer;
};

constexpr Member kMembers[] = {
    {"hash of the scene", "/scene/hash"},
    {"number of the sweep's cases", "/case_count"},
    {"version", "/environment/build/version"},
    {"commit of the build", "/environment/build/commit"},
    {"type of the build", "/environment/build/type"},
    {"device", "/environment/device/name"},
    {"driver version", "/environment/device/driver_version"},
    {"validation layer", "/environment/validation"},
};
// What a software device runs on.
constexpr Member kProcessor = {"processor", "/environment/host/processor"};

std::string known(std::string text) { return text.empty() ? "unknown" : text; }

}  // namespace

std::optional<std::string> identityDifference(const Json& a, const Json& b) {
    const auto difference = [&](const Member& member) -> std::optional<std::string> {
        const std::string mine = known(textAt(a, member.pointer));
        const std::string other = known(textAt(b, member.pointer));
        if (mine == other) return std::nullopt;
        return std::string(member.name) + ": " + mine + " is not " + other;
    };
    for (const Member& member : kMembers)
        if (auto found = difference(member)) return found;
    if (textAt(a, "/environment/device/type") == "cpu") return difference(kProcessor);
    return std::nullopt;
}

}  // namespace benchmarks
