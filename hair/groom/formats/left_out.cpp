#include "hair/groom/formats/left_out.h"

#include <algorithm>
#include <string_view>

namespace hair {
namespace {

struct Row {
    Part part;
    std::string_view sentence;
    bool (*has)(const StrandSet& strands);
};

constexpr Row kRows[] = {
    {Part::widths, "the widths are left out", [](const StrandSet& s) { return s.widths.known(); }},
    {Part::transparencies, "the transparencies are left out",
     [](const StrandSet& s) {
         return !s.transparencies.values.empty() || s.transparencies.everywhere.value_or(0.0f) != 0;
     }},
    {Part::colors, "the colours are left out", [](const StrandSet& s) { return s.colors.known(); }},
    {Part::root_uvs, "the texture coordinates of the roots are left out",
     [](const StrandSet& s) { return !s.root_uvs.empty(); }},
    {Part::root_triangles, "the root triangles are left out",
     [](const StrandSet& s) { return !s.root_triangles.empty(); }},
    {Part::unit, "the unit of length is left out",
     [](const StrandSet& s) { return s.metres_per_unit.has_value(); }},
    {Part::comment, "the comment is left out",
     [](const StrandSet& s) { return !s.comment.empty(); }},
};

}  // namespace

std::vector<std::string> leftOut(const StrandSet& strands, std::initializer_list<Part> held) {
    std::vector<std::string> warnings;
    for (const Row& row : kRows)
        if (std::ranges::find(held, row.part) == held.end() && row.has(strands))
            warnings.emplace_back(row.sentence);
    return warnings;
}

}  // namespace hair
