#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>

#include "hair/groom/formats/npy.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"
#include "tests/python.h"
#include "tests/required.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Makes a zip archive (APPNOTE.TXT 6.3) whose directory names one member `records` times, always
// with the same local header.
std::string
zipOf(int records, std::uint32_t method, std::uint32_t size, const std::string& packed) {
    const std::string name = "positions.npy";
    Bytes local;
    local.u32(0x04034b50).u16(20).u16(0).u16(method).u32(0).u32(0);
    local.u32(static_cast<std::uint32_t>(packed.size())).u32(size);
    local.u16(static_cast<std::uint32_t>(name.size())).u16(0).text(name).text(packed);
    Bytes central;
    for (int i = 0; i < records; ++i) {
        central.u32(0x02014b50).u16(20).u16(20).u16(0).u16(method).u32(0).u32(0);
        central.u32(static_cast<std::uint32_t>(packed.size())).u32(size);
        central.u16(static_cast<std::uint32_t>(name.size())).zeros(12).u32(0).text(name);
    }
    Bytes end;
    end.u32(0x06054b50).u32(0).u16(static_cast<std::uint32_t>(records));
    end.u16(static_cast<std::uint32_t>(records));
    end.u32(static_cast<std::uint32_t>(central.str().size()));
    end.u32(static_cast<std::uint32_t>(local.str().size())).u16(0);
    return local.str() + central.str() + end.str();
}

TEST(Npz, RefusesMembersThatShareTheirBytes) {
    const std::string packed(1000, '\0');
    EXPECT_THAT(
        readError(importNpz, zipOf(40, 0, 1000, packed)),
        HasSubstr("'positions.npy' shares its bytes with others"));
    EXPECT_THAT(readError(importNpz, zipOf(1, 0, 1000, packed)), HasSubstr("checksum"));
}

// Deflate expands one byte to at most 1032 (RFC 1951), so 1 MB could become 1 GB.
TEST(Npz, HoldsWhatIsInflatedAgainstTheFile) {
    EXPECT_THAT(
        readError(importNpz, zipOf(1, 8, 1'000'000'000, std::string(1'000'000, '\0'))),
        HasSubstr("the archive's arrays expand to more than"));
}

// `positions` of make_npy.py.
double madeNumber(int k) { return (k + 1) / 3.0 - double(k * k) / 7.0; }

std::string npyFile(
    const std::string& dictionary, const std::string& numbers, std::string_view version = "\x01") {
    std::string bytes = "\x93NUMPY" + std::string(version) + '\0';
    bytes +=
        {static_cast<char>(dictionary.size() & 0xff), static_cast<char>(dictionary.size() >> 8)};
    return bytes + dictionary + numbers;
}

// Two strands of two points, (k, k + 1, k + 2) each.
std::string fourPoints() {
    Bytes numbers;
    for (int k = 0; k < 4; ++k) numbers.f32(k, k + 1, k + 2);
    return numbers.str();
}

constexpr const char* kDictionary =
    "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 3), }\n";

// Files that NumPy itself wrote.
class NumpyFiles : public testing::Test {
protected:
    void SetUp() override {
        if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    }
    static std::filesystem::path file(const std::string& name) {
        static const std::unique_ptr<const TemporaryFolder> made = make();
        return made->file(name);
    }
    static StrandSet read(const std::string& name) { return importStrands(file(name)); }
    static std::string error(const std::string& name) {
        const std::string text = errorText([&] { read(name); });
        return text.substr(std::min(text.size(), file(name).string().size() + 2));
    }

private:
    static std::unique_ptr<const TemporaryFolder> make() {
        auto folder = std::make_unique<const TemporaryFolder>();
        const Outcome made =
            runPython("tests/groom/formats/make_npy.py", "'" + folder->path().string() + "'");
        if (made.status != 0) throw std::runtime_error(made.output);
        return folder;
    }
};

void expectMadePoints(const StrandSet& set) {
    EXPECT_THAT(set.ends, ElementsAre(4, 8, 12));
    ASSERT_EQ(set.points.size(), 12u);
    for (int k = 0; k < 36; ++k)
        EXPECT_EQ(set.points[static_cast<std::size_t>(k) / 3][k % 3], float(madeNumber(k))) << k;
    EXPECT_EQ(brokenPromise(set), "");
}

TEST_F(NumpyFiles, AreReadInEitherOrderAndPrecisionAndVersion) {
    for (const char* name :
         {"floats.npy", "fortran.npy", "version_1.npy", "version_2.npy", "version_3.npy"}) {
        SCOPED_TRACE(name);
        expectMadePoints(read(name));
        EXPECT_THAT(read(name).warnings, IsEmpty());
    }
    expectMadePoints(read("doubles.npy"));
    EXPECT_THAT(read("doubles.npy").warnings, ElementsAre(HasSubstr("rounded to floats")));
}

TEST_F(NumpyFiles, OfOtherTypesAndShapesAreRefused) {
    EXPECT_THAT(error("big_endian.npy"), AllOf(StartsWith("byte 20: "), HasSubstr("'>f4'")));
    EXPECT_THAT(error("half.npy"), HasSubstr("astype(numpy.float32)"));
    EXPECT_THAT(error("flat.npy"), HasSubstr("(12, 3)"));
    EXPECT_THAT(error("integers.npy"), HasSubstr("'<i4'"));
    EXPECT_THAT(error("none.npy"), HasSubstr("no strands"));
}

TEST_F(NumpyFiles, OfDiffLocksAreRead) {
    for (const char* name : {"difflocks.npz", "difflocks_deflated.npz"}) {
        SCOPED_TRACE(name);
        const StrandSet set = read(name);
        expectMadePoints(set);
        EXPECT_THAT(
            set.root_uvs,
            ElementsAre(glm::vec2(0.25f, 0.75f), glm::vec2(0.5f, 0.125f), glm::vec2(1, 0)));
        EXPECT_THAT(set.warnings, ElementsAre("the arrays 'root_normal' are left out"));
    }
    expectMadePoints(read("unnamed.npz"));
}

TEST_F(NumpyFiles, HaveAllThatStrandsMayHave) {
    const StrandSet set = read("all.npz");
    expectMadePoints(set);
    EXPECT_EQ(set.widths.values.size(), 12u);
    EXPECT_THAT(set.widths.values, Each(0.5f));
    EXPECT_THAT(set.groups, ElementsAre(7, -1, 7));
    EXPECT_THAT(set.guides, ElementsAre(1, 0, 1));
}

TEST_F(NumpyFiles, ThatDoNotFitTogetherAreRefused) {
    EXPECT_THAT(error("two.npz"), AllOf(HasSubstr("'arr_0', 'arr_1'"), HasSubstr(" 2 of ")));
    EXPECT_THAT(error("other_widths.npz"), AllOf(HasSubstr("'widths.npy'"), HasSubstr("(3, 4)")));
    EXPECT_THAT(error("other_guides.npz"), HasSubstr("guide 1 is neither 0 nor 1"));
    EXPECT_EQ(read("zeros_deflated.npz").points, read("zeros.npz").points);
}

// A length, a signature or a checksum covers every byte of an archive, except dates, attributes
// and versions. Names may change only if the directory and the member agree, which a change of one
// byte can't achieve.
TEST_F(NumpyFiles, AreRefusedOrReadWithAnyByteChangedAndWhereverTheyEnd) {
    for (const char* name : {"difflocks.npz", "difflocks_deflated.npz"}) {
        SCOPED_TRACE(name);
        const std::string whole = textOf(file(name));
        const StrandSet expected = readText(importNpz, whole);
        for (std::size_t size = 0; size < whole.size(); ++size)
            EXPECT_THAT(readError(importNpz, whole.substr(0, size)), StartsWith("byte ")) << size;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            std::string damaged = whole;
            damaged[i] = static_cast<char>(damaged[i] ^ 0x11);
            try {
                const StrandSet read = readText(importNpz, damaged);
                EXPECT_EQ(read.points, expected.points) << i;
                EXPECT_EQ(read.root_uvs, expected.root_uvs) << i;
            } catch (const engine::Error& error) {
                EXPECT_THAT(error.what(), StartsWith("byte ")) << i;
            }
        }
    }
}

// Python's zipfile checks the checksums, and float.hex() shows every bit.
TEST_F(NumpyFiles, AreWrittenAsNumpyReadsThem) {
    StrandSet strands = hardStrands();
    strands.ends = {5, 10};
    strands.root_uvs = {{0.1f, 0.2f}, {0.3f, 0.4f}};
    strands.groups = {-5, 1};
    strands.guides = {0, 1};
    const TemporaryFolder folder;
    EXPECT_THAT(
        exportStrands(strands, folder.file("a.npz")),
        ElementsAre(HasSubstr("transparencies"), HasSubstr("colours")));
    EXPECT_THAT(
        exportStrands(strands, folder.file("a.npy")),
        ElementsAre(
            HasSubstr("widths"), HasSubstr("transparencies"), HasSubstr("colours"),
            HasSubstr("texture"), HasSubstr("groups"), HasSubstr("guides")));
    const Outcome loaded = runPython(
        "tests/groom/formats/load_npy.py",
        "'" + folder.file("a.npz").string() + "' '" + folder.file("a.npy").string() + "'");
    ASSERT_EQ(loaded.status, 0) << loaded.output;
    EXPECT_THAT(
        loaded.output,
        AllOf(
            StartsWith("positions <f4 (2, 5, 3) C 0x0.0p+0 -0x0.0p+0 "),
            HasSubstr("\nroot_uv <f4 (2, 2) C 0x1.99999a"), HasSubstr("\nwidths <f4 (2, 5) C"),
            HasSubstr("\ngroups <i4 (2,) C -0x1.4000000000000p+2 0x1.0000000000000p+0\n"),
            HasSubstr("\nguides |u1 (2,) C 0x0.0p+0 0x1.0000000000000p+0\n"),
            HasSubstr("\n <f4 (2, 5, 3) C 0x0.0p+0 -0x0.0p+0 ")));
    const StrandSet read = importStrands(folder.file("a.npz"));
    EXPECT_EQ(read.ends, strands.ends);
    expectBitEqual(read.points, strands.points);
    expectBitEqual(read.widths.values, strands.widths.values);
    expectBitEqual(read.root_uvs, strands.root_uvs);
    EXPECT_EQ(read.groups, strands.groups);
    EXPECT_EQ(read.guides, strands.guides);
    EXPECT_THAT(read.warnings, IsEmpty());
    expectBitEqual(importStrands(folder.file("a.npy")).points, strands.points);
}

TEST(Npy, ResamplesStrandsOfDifferingNumbersOfPoints) {
    StrandSet ragged{
        .ends = {2, 5}, .points = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}};
    const Written written = writeText(exportNpy, ragged);
    EXPECT_THAT(written.warnings, ElementsAre(HasSubstr("resampled to 3 each")));
    const StrandSet read = readText(importNpy, written.bytes);
    EXPECT_THAT(read.ends, ElementsAre(3, 6));
    EXPECT_EQ(read.points[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(errorText([] { writeText(exportNpz, {}); }), "there are no strands");
}

TEST(Npy, ReadsHeadersAsPythonMayWriteThem) {
    for (const char* dictionary :
         {kDictionary, "{'descr':'<f4','fortran_order':False,'shape':(2,2,3)}",
          "{\"shape\": (2, 2, 3), \"descr\": \"<f4\", \"fortran_order\": False}      \n"}) {
        const StrandSet set = readText(importNpy, npyFile(dictionary, fourPoints()));
        EXPECT_THAT(set.ends, ElementsAre(2, 4)) << dictionary;
        EXPECT_EQ(set.points[3], glm::vec3(3, 4, 5)) << dictionary;
    }
}

TEST(Npy, RefusesOtherHeaders) {
    const auto headerError = [](const std::string& dictionary) {
        return readError(importNpy, npyFile(dictionary, fourPoints()));
    };
    const char* const wrong[] = {
        "",
        "{",
        "{}",
        "()",
        "{'descr': '<f4', 'fortran_order': False}",
        "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 3)}",
        "{'descr': '<f4', 'fortran_order': 0, 'shape': (2, 2, 3)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, -3)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 3)",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2 2, 3)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 99999999999999999999)}",
        "{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (2, 2, 3)}",
        "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 3)} and more"};
    for (const char* dictionary : wrong)
        EXPECT_THAT(headerError(dictionary), StartsWith("byte ")) << dictionary;
    EXPECT_THAT(
        readError(importNpy, npyFile(kDictionary, fourPoints(), "\x04")), HasSubstr("version 4"));
}

// 2^22 * 2^22 * 2^22 * 4 is 0 in 64 bits.
TEST(Npy, BelievesNoShapeThatTheFileIsTooShortFor) {
    for (const char* shape :
         {"(2, 3, 3)", "(4194304, 4194304, 4194304)", "(0, 4194304, 4194304, 4194304)",
          "(9223372036854775807, 2, 3)", "(2, 1, 3)"}) {
        const std::string dictionary =
            std::string("{'descr': '<f4', 'fortran_order': False, 'shape': ") + shape + "}";
        EXPECT_THAT(
            readError(importNpy, npyFile(dictionary, fourPoints())),
            testing::AnyOf(
                testing::MatchesRegex("byte .+: truncated.*"),
                testing::MatchesRegex("byte .+: .*trailing bytes.*")))
            << shape;
    }
}

TEST(Npy, IsRefusedWhereverItEnds) {
    const std::string whole = npyFile(kDictionary, fourPoints());
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THAT(
            readError(importNpy, whole.substr(0, size)),
            testing::MatchesRegex("byte .+: .*truncated.*"))
            << size;
}

// Two strands of two points.
TEST(Npy, LeavesOutStrandsThatAreNotFinite) {
    const std::string whole = npyFile(kDictionary, fourPoints());
    const std::size_t start = whole.size() - 48;
    for (const float wrong : kNotFinite) {
        const StrandSet set = readText(importNpy, patched(whole, start + 16, wrong));
        EXPECT_EQ(set.strandCount(), 1u);
        EXPECT_THAT(set.warnings, testing::ElementsAre(leftOutStrand(kNoPosition, 0)));
    }
}

}  // namespace
}  // namespace hair::groom
