#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "engine/error.h"
#include "hair/groom/files.h"
#include "tests/groom/formats/broken_promise.h"

namespace {

const hair::groom::StrandImporter& importer() {
    for (const hair::groom::StrandImporter& row : hair::groom::strandImporters())
        if (std::ranges::find(row.extensions, HAIRBENCH_FUZZ_EXTENSION) != row.extensions.end())
            return row;
    std::fprintf(stderr, "no importer reads " HAIRBENCH_FUZZ_EXTENSION "\n");
    std::exit(2);
}

}  // namespace

// Bytes are refused with an engine::Error or make a set as it ought to be. Called by libFuzzer.
extern "C" __attribute__((visibility("default"))) int
LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
    static const hair::groom::StrandImporter& row = importer();
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
