#include <gmock/gmock.h>

#include "hair/groom/formats/polylines.h"
#include "tests/error_text.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string place(std::size_t edge) { return "edge " + std::to_string(edge); }

Polylines chain(const std::vector<Edge>& edges) { return chainEdges(edges, 10, place); }

std::string chainError(const std::vector<Edge>& edges) {
    return errorText([&] { chain(edges); });
}

TEST(ChainEdges, MakesStrandsInOrderOfFirstUse) {
    const Polylines lines = chain({{5, 6}, {0, 1}, {6, 7}, {1, 2}});
    EXPECT_THAT(lines.ends, ElementsAre(3, 6));
    EXPECT_THAT(lines.vertices, ElementsAre(5, 6, 7, 0, 1, 2));
}

TEST(ChainEdges, BeginsAtTheEndThatComesFirstAmongTheVertices) {
    EXPECT_THAT(chain({{3, 9}, {9, 2}}).vertices, ElementsAre(2, 9, 3));
    EXPECT_THAT(chain({{8, 4}}).vertices, ElementsAre(4, 8));
}

TEST(ChainEdges, TakesEdgesInAnyOrderAndDirection) {
    EXPECT_THAT(chain({{3, 2}, {0, 1}, {4, 3}, {2, 1}}).vertices, ElementsAre(0, 1, 2, 3, 4));
}

TEST(ChainEdges, RefusesWhatIsNoChain) {
    EXPECT_THAT(
        chainError({{0, 1}, {1, 2}, {1, 3}}),
        HasSubstr("edge 2: this is a third edge at vertex 1"));
    EXPECT_THAT(
        chainError({{7, 8}, {0, 1}, {1, 2}, {2, 0}}), HasSubstr("edge 1: the edge belongs"));
    EXPECT_THAT(chainError({{0, 1}, {1, 0}}), HasSubstr("closed loop"));
    EXPECT_THAT(chainError({{4, 4}}), HasSubstr("edge 0: the edge joins vertex 4 to itself"));
    EXPECT_THAT(
        chainError({{0, 1}, {1, 10}}),
        HasSubstr("edge 1: the edge names vertex 10, but there are 10"));
}

TEST(ChainEdges, HasNoStrandsWithoutEdges) { EXPECT_TRUE(chain({}).ends.empty()); }

TEST(EdgesOf, GivesTheSameStrandsBack) {
    StrandSet strands;
    strands.ends = {3, 4, 6};
    strands.points.resize(6);
    std::vector<std::string> warnings;
    const std::vector<Edge> edges = edgesOf(strands, warnings);
    EXPECT_THAT(edges, ElementsAre(Edge{0, 1}, Edge{1, 2}, Edge{4, 5}));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("1 strands of a single point")));
    EXPECT_THAT(chain(edges).ends, ElementsAre(3, 5));
}

TEST(EdgesOf, RefusesPointsOnly) {
    StrandSet strands;
    strands.ends = {1};
    strands.points.resize(1);
    std::vector<std::string> warnings;
    EXPECT_THAT(errorText([&] { edgesOf(strands, warnings); }), HasSubstr("no strand has the two"));
    EXPECT_THAT(errorText([&] { edgesOf({}, warnings); }), HasSubstr("no strand has the two"));
}

}  // namespace
}  // namespace hair::groom
