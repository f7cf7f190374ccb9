#include "benchmarks/viewer/script/verbs.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "benchmarks/names.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

constexpr Verb kVerbs[] = {
    {"wait", readWait},       {"frames", readFrames}, {"play", readPlay},
    {"seek", readSeek},       {"set", readSet},       {"perform", readPerform},
    {"drop", readDrop},       {"resize", readResize}, {"move", readMove},
    {"click", readClick},     {"drag", readDrag},     {"scroll", readScroll},
    {"key", readKey},         {"type", readType},     {"screenshot", readScreenshot},
    {"picture", readPicture}, {"save", readSave},     {"state", readState},
    {"expect", readExpect},
};

}  // namespace

std::span<const Verb> verbTable() { return kVerbs; }

const Verb& verbNamed(const std::string& name, const std::string& pointer) {
    const auto found = std::ranges::find(kVerbs, std::string_view(name), &Verb::name);
    if (found != std::end(kVerbs)) return *found;
    std::vector<std::string> known;
    for (const Verb& verb : kVerbs) known.emplace_back(verb.name);
    throw engine::Error(pointer, unknownName("unknown verb", name, known));
}

}  // namespace benchmarks
