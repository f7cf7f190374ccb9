#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "hair/rendering/backends.h"

// What back ends don't draw.
namespace hair::rendering {
namespace {

std::string refusal(const Settings& settings) {
    try {
        checkBackend(settings);
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
        refusal(blended), "/strands/backend: a /render/transparency but none is not drawn: it "
                          "keeps one strand a sample");
    EXPECT_EQ(
        refusal(shown),
        "/strands/backend: a /render/show but shading is not drawn: it only shades");
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

// docs/rendering.md has a row for each, and no other.
TEST(BackendLimits, AreThoseOfTheDocumentation) {
    std::ifstream page(HAIRBENCH_SOURCE_DIR "/docs/rendering.md");
    std::set<std::string> written;
    bool in_table = false;
    for (std::string line; std::getline(page, line);) {
        if (line == "| `/strands/backend` | does not draw | because |") in_table = true;
        if (in_table && !line.starts_with("|")) break;
        if (in_table && line.starts_with("| `") && !line.starts_with("| `/")) written.insert(line);
    }
    std::set<std::string> known;
    for (const BackendLimit& limit : backendLimits()) {
        ASSERT_TRUE(limit.backend == Backend::software || limit.backend == Backend::lines);
        const std::string name = limit.backend == Backend::software ? "software" : "lines";
        known.insert(
            "| `" + name + "` | " + std::string(limit.asked_for) + " | " +
            std::string(limit.reason) + " |");
    }
    EXPECT_EQ(written, known);
}

}  // namespace
}  // namespace hair::rendering
