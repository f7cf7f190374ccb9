#include "benchmarks/compare/environment_differences.h"

#include <utility>

#include "benchmarks/text_at.h"

namespace benchmarks {

namespace {

struct Place {
    const char* name;
    const char* pointer;
};

constexpr Place kPlaces[] = {
    {"device", "/environment/device/name"},
    {"kind of device", "/environment/device/type"},
    {"driver", "/environment/device/driver"},
    {"driver's version", "/environment/device/driver_version"},
    {"processor", "/environment/host/processor"},
    {"number of processors", "/environment/host/processor_count"},
    {"build type", "/environment/build/type"},
    {"scene", "/scene/hash"},
};

bool isTrue(const Json& report, const char* pointer) { return textAt(report, pointer) == "true"; }

}  // namespace

bool isSameDevice(const Json& a, const Json& b) {
    for (const char* const pointer : {"/environment/device/name", "/environment/device/type"})
        if (textAt(a, pointer) != textAt(b, pointer)) return false;
    return true;
}

std::vector<std::string> environmentDifferences(const Json& a, const Json& b) {
    std::vector<std::string> differences;
    for (const Place& place : kPlaces) {
        const std::string of_a = textAt(a, place.pointer);
        const std::string of_b = textAt(b, place.pointer);
        if (!of_a.empty() && !of_b.empty() && of_a != of_b)
            differences.push_back(std::string(place.name) + ": " + of_a + " and " + of_b);
    }
    for (const auto& [report, name] : {std::pair{&a, "A"}, std::pair{&b, "B"}}) {
        if (isTrue(*report, "/environment/validation"))
            differences.push_back(std::string(name) + " ran under the validation layer");
        if (isTrue(*report, "/interrupted"))
            differences.push_back(std::string(name) + " was interrupted: some cases are missing");
    }
    return differences;
}

}  // namespace benchmarks
