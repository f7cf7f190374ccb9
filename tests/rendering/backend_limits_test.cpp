#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/instance.h"
#include "hair/rendering/backends.h"
#include "tests/gpu_fixture.h"

// The limits of back ends.
namespace hair::rendering {
namespace {

std::string refusal(const Settings& settings) {
    try {
        checkBackend(settings.strands.backend, settings);
    } catch (const engine::Unsupported& error) {
        return error.what();
    }
    return "drawn";
}

Settings software() {
    Settings settings;
    settings.strands.backend = Backend::software;
    return settings;
}

TEST(BackendLimits, AreRefusedWithTheirReason) {
    Settings blended = software();
    blended.render.transparency = Transparency::weighted_blended;
    Settings shown = software();
    shown.render.show = Show::tangents;
    Settings textured = software();
    textured.strands.texture = "bands.png";
    EXPECT_EQ(
        refusal(blended),
        "/strands/backend: a /render/transparency other than none is not drawn: it "
        "keeps one strand per sample");
    EXPECT_EQ(
        refusal(shown), "/strands/backend: a /render/show other than shading is not drawn: it can "
                        "only draw shaded strands");
    EXPECT_EQ(
        refusal(textured),
        "/strands/backend: /strands/texture is not drawn: its strands have no holes");
    EXPECT_EQ(refusal(software()), "drawn");
    Settings covered;
    covered.strands.backend = Backend::lines;
    EXPECT_EQ(refusal(covered), "drawn");
    covered.render.coverage = Coverage::analytic;
    EXPECT_EQ(
        refusal(covered), "/strands/backend: /render/coverage analytic is not drawn: its lines "
                          "are a pixel wide");
}

TEST(BackendLimits, AreThoseOfTheirOwnBackEnd) {
    for (const Backend backend :
         {Backend::tessellation, Backend::pulling_geometry, Backend::pulling, Backend::expanded}) {
        Settings settings;
        settings.strands.backend = backend;
        settings.render.transparency = Transparency::fragment_list;
        settings.render.show = Show::strands;
        settings.strands.texture = "bands.png";
        EXPECT_EQ(refusal(settings), "drawn");
    }
}

// Rows of a table in docs/rendering.md.
std::set<std::string> rowsBelow(const std::string& head) {
    std::ifstream page(HAIRBENCH_SOURCE_DIR "/docs/rendering.md");
    std::set<std::string> rows;
    bool in_table = false;
    for (std::string line; std::getline(page, line);) {
        if (in_table && !line.starts_with("|")) break;
        if (in_table && !line.starts_with("|--")) rows.insert(line);
        if (line == head) in_table = true;
    }
    return rows;
}

// docs/rendering.md has a row for each, and no other.
TEST(BackendLimits, AreThoseOfTheDocumentation) {
    std::set<std::string> known;
    for (const BackendLimit& limit : backendLimits())
        known.insert(
            "| `" + std::string(backendName(limit.backend)) + "` | " +
            std::string(limit.asked_for) + " | " + std::string(limit.reason) + " |");
    EXPECT_EQ(rowsBelow("| `/strands/backend` | does not draw | because |"), known);
}

std::string orderRow(const std::string& devices, engine::DeviceType type) {
    std::string row = "| " + devices + " | ";
    for (const Backend backend : backendOrder({.type = type}))
        row += (row.ends_with("| ") ? "`" : ", `") + std::string(backendName(backend)) + "`";
    return row + " |";
}

TEST(BackendOrder, IsThatOfTheDocumentation) {
    EXPECT_EQ(
        rowsBelow("| `/strands/backend` `automatic` on | first to last |"),
        (std::set{
            orderRow("processors", engine::DeviceType::cpu),
            orderRow("graphics processors", engine::DeviceType::discrete)}));
}

// Every device's order has all back ends that draw the same strands, which are all except `lines`,
// and were measured on it: `rays` was not on a GPU, and is far behind on processors.
TEST(BackendOrder, HasEveryBackEndOfTheSamePicture) {
    using enum engine::DeviceType;
    for (const engine::DeviceType type : {discrete, integrated, virtual_gpu, cpu, other})
        EXPECT_THAT(
            backendOrder({.type = type}),
            testing::UnorderedElementsAre(
                Backend::tessellation, Backend::pulling_geometry, Backend::pulling,
                Backend::expanded, Backend::mesh, Backend::software))
            << engine::deviceTypeName(type);
}

class BackendChoiceTest : public GpuTest {
protected:
    BackendChoice choice(const Settings& settings, const StrandStages& stages = {}) const {
        return chooseBackend(device(), settings, StrandPlan{}, stages);
    }
};

TEST_F(BackendChoiceTest, IsTheFirstThatDrawsTheCase) {
    const Settings plain;
    ASSERT_EQ(plain.strands.backend, Backend::automatic);
    EXPECT_EQ(choice(plain).backend, Backend::software);
    EXPECT_EQ(choice(plain).reason, "automatic: the first that can draw it");

    Settings blended;
    blended.render.transparency = Transparency::fragment_list;
    const BackendChoice other = choice(blended);
    EXPECT_EQ(other.backend, backendOrder(device().info())[1]);
    EXPECT_EQ(
        other.reason,
        "automatic: the first that can draw it; not software: /strands/backend: a "
        "/render/transparency other than none is not drawn: it keeps one strand per sample");
}

TEST_F(BackendChoiceTest, IsTheScenesOwn) {
    Settings settings;
    settings.strands.backend = Backend::pulling;
    EXPECT_EQ(choice(settings).backend, Backend::pulling);
    EXPECT_EQ(choice(settings).reason, "the scene names it");
    settings.strands.backend = Backend::software;
    settings.render.show = Show::tangents;
    EXPECT_THROW(choice(settings), engine::Unsupported);
    settings.render.hair = false;
    EXPECT_NO_THROW(choice(settings));
}

TEST_F(BackendChoiceTest, IsTessellationWhereItsStagesAreLeftOut) {
    EXPECT_EQ(choice(Settings{}, {.last = StrandStage::raster}).backend, Backend::tessellation);
}

}  // namespace
}  // namespace hair::rendering
