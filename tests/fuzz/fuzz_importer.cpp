#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/error.h"
#include "hair/groom/files.h"
#include "tests/groom/formats/broken_promise.h"

namespace {

// The importers that read from memory, each once: those of two formats can be one.
std::vector<const hair::groom::StrandImporter*> importers() {
    std::vector<const hair::groom::StrandImporter*> all;
    for (const hair::groom::StrandImporter& row : hair::groom::strandImporters())
        if (row.from_memory &&
            std::ranges::find(all, row.read, &hair::groom::StrandImporter::read) == all.end())
            all.push_back(&row);
    return all;
}

// The name of an importer here and of its folder in tests/corpus: its first extension's, without
// the dot.
std::string_view nameOf(const hair::groom::StrandImporter& importer) {
    return importer.extensions.front().substr(1);
}

// That of $HAIRBENCH_FUZZ_FORMAT.
const hair::groom::StrandImporter& chosenImporter() {
    const char* const format = std::getenv("HAIRBENCH_FUZZ_FORMAT");
    for (const hair::groom::StrandImporter* const row : importers())
        if (format && nameOf(*row) == format) return *row;
    std::fprintf(stderr, "HAIRBENCH_FUZZ_FORMAT is none of those that --formats lists\n");
    std::exit(2);
}

}  // namespace

// --formats lists what there is to fuzz. Called by libFuzzer.
extern "C" __attribute__((visibility("default"))) int
LLVMFuzzerInitialize(const int* argc, const char* const* const* argv) {
    const std::span<const char* const> arguments(*argv, static_cast<std::size_t>(*argc));
    if (std::ranges::find(arguments, std::string_view("--formats")) == arguments.end()) return 0;
    for (const hair::groom::StrandImporter* const row : importers())
        std::printf("%s\n", std::string(nameOf(*row)).c_str());
    std::exit(0);
}

// Bytes are refused with an engine::Error or make a set as it ought to be. Called by libFuzzer.
extern "C" __attribute__((visibility("default"))) int
LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
    static const hair::groom::StrandImporter& row = chosenImporter();
    try {
        const hair::groom::StrandSet set =
            row.read({.bytes = std::as_bytes(std::span(bytes, size))});
        const std::string broken = hair::groom::brokenPromise(set);
        if (broken.empty()) return 0;
        std::fprintf(stderr, "not so: %s\n", broken.c_str());
        std::abort();
    } catch (const engine::Error&) {
        return 0;
    }
}
