#include "benchmarks/run/identity.h"

#include <nlohmann/json.hpp>

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

// "unknown" where it is absent.
std::string text(const Json& report, const char* pointer) {
    const Json::json_pointer place(pointer);
    if (!report.contains(place)) return "unknown";
    const Json& value = report.at(place);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

std::optional<std::string> identityDifference(const Json& a, const Json& b) {
    const auto difference = [&](const Member& member) -> std::optional<std::string> {
        const std::string mine = text(a, member.pointer);
        const std::string other = text(b, member.pointer);
        if (mine == other) return std::nullopt;
        return std::string(member.name) + ": " + mine + " is not " + other;
    };
    for (const Member& member : kMembers)
        if (auto found = difference(member)) return found;
    if (text(a, "/environment/device/type") == "cpu") return difference(kProcessor);
    return std::nullopt;
}

}  // namespace benchmarks
