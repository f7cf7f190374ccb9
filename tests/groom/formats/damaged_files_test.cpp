#include <gmock/gmock.h>

#include "hair/groom/formats/formats.h"
#include "hair/groom/formats/ply.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/strand_files.h"

// The tests damage every byte of files. Each damaged file must give an error in one line or
// strands that keep the promises of StrandSet, never a crash. The sanitized build of this test
// finds reads outside the file.
namespace hair::groom {
namespace {

struct Format {
    const char* name;
    ReadStrands read;
    WriteStrands write;
    bool counts;  // the file's contents give its length
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

class DamagedFile : public testing::TestWithParam<Format> {
protected:
    std::string valid() const { return writeText(GetParam().write, hardStrands()).bytes; }

    // Returns whether it was read.
    bool survives(const std::string& bytes) const {
        try {
            EXPECT_EQ(brokenPromise(readText(GetParam().read, bytes)), "");
            return true;
        } catch (const engine::Error& error) {
            EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
            return false;
        }
    }
};

TEST_P(DamagedFile, IsRefusedWhereverItEnds) {
    const std::string bytes = valid();
    for (std::size_t size = 0; size + 1 < bytes.size(); ++size)
        EXPECT_FALSE(survives(bytes.substr(0, size)) && GetParam().counts) << size;
}

TEST_P(DamagedFile, IsReadOrRefusedWithAnyByteChanged) {
    const std::string bytes = valid();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        for (const int change : {0x01, 0x10, 0x80, 0xff}) {
            std::string damaged = bytes;
            damaged[i] = static_cast<char>(damaged[i] ^ change);
            survives(damaged);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, DamagedFile,
    testing::Values(
        Format{"data", importHairData, exportHairData, true},
        Format{"ply", importPly, exportPly, true}, Format{"obj", importObj, exportObj, false},
        Format{"gltf", importGltfStrands, exportGltf, true},
        Format{"glb", importGltfStrands, exportGlb, true}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace hair::groom
