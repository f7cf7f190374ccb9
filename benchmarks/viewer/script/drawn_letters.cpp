#include "benchmarks/viewer/script/drawn_letters.h"

#include <optional>

#include <imgui.h>

namespace benchmarks {

namespace {

// Letters reach over their advance, and so over what was made as wide as their text, by parts of a
// pixel.
constexpr float kTolerance = 1.0f;  // px
// One that is whole has all of its part of the texture, to the last bit.
constexpr float kWhole = 0.999f;

struct Quad {
    ImDrawVert first;  // top left
    ImDrawVert last;   // bottom right
};

// The rectangle that six indices draw, in the order in which Dear ImGui draws letters.
std::optional<Quad> quadAt(const ImDrawList& list, const ImDrawCmd& command, unsigned index) {
    const ImDrawIdx* const i = &list.IdxBuffer[static_cast<int>(command.IdxOffset + index)];
    const unsigned v = i[0];
    if (i[1] != v + 1 || i[2] != v + 2 || i[3] != v || i[4] != v + 2 || i[5] != v + 3)
        return std::nullopt;
    const auto vertex = [&](unsigned at) {
        return list.VtxBuffer[static_cast<int>(command.VtxOffset + at)];
    };
    return Quad{vertex(v), vertex(v + 2)};
}

// The letter in whose part of the texture the middle of the rectangle is; none for a shape.
const ImFontGlyph* glyphOf(const Quad& quad) {
    if (quad.first.uv.x == quad.last.uv.x) return nullptr;  // one colour
    const float u = 0.5f * (quad.first.uv.x + quad.last.uv.x);
    const float v = 0.5f * (quad.first.uv.y + quad.last.uv.y);
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
        for (const ImFontGlyph& glyph : font->Glyphs)
            if (u > glyph.U0 && u < glyph.U1 && v > glyph.V0 && v < glyph.V1) return &glyph;
    return nullptr;
}

bool isSeen(const Quad& quad, const ImVec4& clip) {
    return (quad.first.col & IM_COL32_A_MASK) != 0 && quad.first.pos.y < clip.w &&
           quad.last.pos.y > clip.y && quad.first.pos.x < clip.z && quad.last.pos.x > clip.x;
}

// The share of the letter that its rectangle still has.
float shareOf(const Quad& quad, const ImFontGlyph& glyph) {
    return (quad.last.uv.x - quad.first.uv.x) / (glyph.U1 - glyph.U0);
}

float penOf(const Quad& quad, const ImFontGlyph& glyph) {
    const float width = (quad.last.pos.x - quad.first.pos.x) / shareOf(quad, glyph);
    return quad.first.pos.x - glyph.X0 * width / (glyph.X1 - glyph.X0);
}

bool isCut(const Quad& quad, const ImFontGlyph& glyph, const ImVec4& clip) {
    return shareOf(quad, glyph) < kWhole || quad.first.pos.x < clip.x - kTolerance ||
           quad.last.pos.x > clip.z + kTolerance;
}

}  // namespace

std::vector<DrawnLetter> drawnLetters(const ImDrawList& list) {
    std::vector<DrawnLetter> letters;
    const ImTextureID texture = ImGui::GetIO().Fonts->TexID;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback || command.GetTexID() != texture) continue;
        for (unsigned index = 0; index + 6 <= command.ElemCount;) {
            const std::optional<Quad> quad = quadAt(list, command, index);
            index += quad ? 6 : 3;
            if (!quad || !isSeen(*quad, command.ClipRect)) continue;
            if (const ImFontGlyph* const glyph = glyphOf(*quad))
                letters.push_back(
                    {.codepoint = glyph->Codepoint,
                     .pen = penOf(*quad, *glyph),
                     .left = quad->first.pos.x,
                     .right = quad->last.pos.x,
                     .top = quad->first.pos.y,
                     .bottom = quad->last.pos.y,
                     .cut = isCut(*quad, *glyph, command.ClipRect)});
        }
    }
    return letters;
}

}  // namespace benchmarks
