#include "hair/groom/other_formats.h"

#include <algorithm>
#include <array>

namespace hair::groom {
namespace {

using namespace std::string_view_literals;

// A file begins with `magic`, and has `within` among its first bytes.
struct OtherRow {
    std::string_view magic;
    OtherFile file;
    // Extensions of formats that are read and begin alike.
    std::array<std::string_view, 4> may_be{};
    std::string_view within{};
};

constexpr std::string_view kToUsd = "import it in Blender and export its curves as USD";
constexpr std::string_view kFromMaya = "export its curves as USD from Maya";
constexpr std::string_view kFromHoudini = "export its curves as USD or Alembic from Houdini";
constexpr std::string_view kUnpack = "unpack it and give its contents";
constexpr std::string_view kSavez = "load it in Python and write its arrays with numpy.savez";
constexpr std::string_view kOverwritten =
    "it is a page that a server sent in place of the file: download the file itself, perhaps after "
    "logging in";

constexpr OtherRow kOtherFiles[] = {
    {"version https://git-lfs.github.com/spec/",
     {"a pointer of Git LFS", "it stands for a large file: run 'git lfs pull' where it is from"}},
    {"/annex/objects/",
     {"a pointer of git-annex",
      "it stands for a large file: run 'git annex get' where it is from"}},
    {"<!doctype html", {"a page in HTML", kOverwritten}},
    {"<html", {"a page in HTML", kOverwritten}},
    {"\x89HDF\r\n\x1a\n",
     {"an HDF5 file, such as an Alembic file from before 2013",
      "convert it with Alembic's \"abcconvert -toOgawa\""}},
    {"Kaydara FBX Binary", {"an FBX file", kToUsd}},
    {"; FBX ", {"an FBX file in text", kToUsd}},
    {"BLENDER", {"a Blender file", "export its curves as USD from Blender"}},
    {"\x28\xb5\x2f\xfd",
     {"a file compressed with Zstandard, as Blender's are",
      "export its curves as USD from Blender, or decompress it"}},
    {"//Maya ASCII", {"a Maya scene (ASCII)", kFromMaya}},
    {"FOR4", {"a Maya scene or cache (binary)", kFromMaya}},
    {"FOR8", {"a Maya scene or cache (binary)", kFromMaya}},
    {"\x7fNSJ", {"a file of Houdini's geometry", kFromHoudini}},
    {"PK\x03\x04", {"a file of PyTorch", kSavez}, {".npz"}, "data.pkl"},
    {"PK\x03\x04", {"a zip archive", kUnpack}, {".npz", ".usdz"}},
    {"#usda", {"a USD file", "name it .usda"}, {".usd", ".usda", ".usdc"}},
    {"PXR-USDC", {"a USD file", "name it .usdc"}, {".usd", ".usda", ".usdc"}},
    {"Rar!\x1a\x07", {"a RAR archive", kUnpack}},
    {"7z\xbc\xaf\x27\x1c", {"a 7-Zip archive", kUnpack}},
    {"\x1f\x8b\x08", {"a file compressed with gzip", kUnpack, false}},
    {"\x80\x02", {"a Python pickle", kSavez, false}},
    {"\x80\x03", {"a Python pickle", kSavez, false}},
    {"\x80\x04\x95", {"a Python pickle", kSavez, false}},
    {"\x80\x05\x95", {"a Python pickle", kSavez, false}},
};

// Whether the text begins with `beginning`, which is in lower case.
bool startsWithInAnyCase(std::string_view text, std::string_view beginning) {
    if (text.size() < beginning.size()) return false;
    return std::ranges::equal(text.substr(0, beginning.size()), beginning, [](char a, char b) {
        return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
}

// Skips what may be before a page's first tag.
std::string_view withoutSpace(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

bool begins(std::string_view head, const OtherRow& row) {
    if (row.magic.starts_with('<')) return startsWithInAnyCase(withoutSpace(head), row.magic);
    return head.starts_with(row.magic);
}

}  // namespace

std::string OtherFile::text() const {
    return "is " + std::string(name) + ", which is not read: " + std::string(advice);
}

const OtherFile* recognise(std::string_view head, std::string_view extension) {
    for (const OtherRow& row : kOtherFiles) {
        const bool may_be_ours = !extension.empty() &&  // unused elements of may_be are empty, too
                                 std::ranges::find(row.may_be, extension) != row.may_be.end();
        const bool has_within = row.within.empty() || head.find(row.within) != head.npos;
        if (begins(head, row) && has_within && !may_be_ours) return &row.file;
    }
    return nullptr;
}

std::string
explained(const std::string& reason, std::string_view head, std::string_view extension) {
    const OtherFile* const other = recognise(head, extension);
    return other ? reason + "; by its first bytes it " + other->text() : reason;
}

}  // namespace hair::groom
