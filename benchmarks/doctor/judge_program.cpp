#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/texts.h"

namespace benchmarks {

namespace {

bool contains(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

// Picks a device and takes no part in what is submitted to it.
bool isHarmless(const std::string& layer) { return contains(layer, "MESA_device_select"); }

}  // namespace

Judgement judgeDevice(const Facts& facts) {
    std::string seen = facts.device.name + " (" + facts.device.type + ")";
    if (facts.device.type != "cpu") return {Health::ok, seen};
    return {Health::ok, seen + ": times are those of the processors; judge by CPU time too"};
}

Judgement judgeBuild(const Facts& facts) {
    const BuildRecord& build = facts.build.build;
    std::string seen = build.type.empty() ? "no build type" : build.type;
    if (!build.flags.empty()) seen += " (" + build.flags + ")";
    if (facts.build.assertions) seen += ", assertions on";
    if (build.dirty == true) seen += ", not as committed";
    if (facts.build.assertions || contains(build.flags, "-fsanitize") ||
        !build.type.starts_with("Rel"))
        return {Health::bad, seen, "measure with the release preset"};
    if (build.dirty == true)
        return {Health::warn, seen, "commit before you keep results: nobody can build this again"};
    return {Health::ok, seen};
}

Judgement judgeLayers(const Facts& facts) {
    if (facts.layers.validation)
        return {Health::bad, "the validation layer is on", "leave out --validate"};
    if (facts.layers.loaded.empty()) return {Health::ok, "none"};
    Judgement judgement{Health::ok, joined(facts.layers.loaded, ", ")};
    for (const std::string& layer : facts.layers.loaded) {
        if (isHarmless(layer)) continue;
        judgement.health = Health::warn;
        judgement.advice = "layers take time of every call: unset VK_INSTANCE_LAYERS and "
                           "VK_LOADER_LAYERS_ENABLE, or set VK_LOADER_LAYERS_DISABLE='*'";
        if (contains(layer, "validation")) {
            judgement.health = Health::bad;
            return judgement;
        }
    }
    return judgement;
}

}  // namespace benchmarks
