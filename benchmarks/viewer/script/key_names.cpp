#include "benchmarks/viewer/script/key_names.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include <imgui.h>

#include "benchmarks/names.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

struct Named {
    std::string_view name;
    int key;
};

constexpr Named kModifiers[] = {
    {"ctrl", ImGuiMod_Ctrl},
    {"shift", ImGuiMod_Shift},
    {"alt", ImGuiMod_Alt},
    {"super", ImGuiMod_Super}};

// Beside Dear ImGui's own names.
constexpr Named kOthers[] = {
    {"left", ImGuiKey_LeftArrow}, {"right", ImGuiKey_RightArrow}, {"up", ImGuiKey_UpArrow},
    {"down", ImGuiKey_DownArrow}, {".", ImGuiKey_Period},         {",", ImGuiKey_Comma},
    {"/", ImGuiKey_Slash},        {"-", ImGuiKey_Minus},          {"=", ImGuiKey_Equal},
    {"[", ImGuiKey_LeftBracket},  {"]", ImGuiKey_RightBracket}};

std::string lowerCase(std::string text) {
    std::ranges::transform(
        text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

}  // namespace

int keyChord(const std::string& text, const std::string& pointer) {
    int chord = 0;
    std::string rest = lowerCase(text);
    const auto takeModifier = [&] {
        for (const Named& modifier : kModifiers) {
            const bool with_key = rest.starts_with(std::string(modifier.name) + '+');
            if (!with_key && rest != modifier.name) continue;
            chord |= modifier.key;
            rest.erase(0, modifier.name.size() + (with_key ? 1 : 0));
            return true;
        }
        return false;
    };
    while (takeModifier()) {
    }
    if (rest.empty() && chord != 0) return chord;  // of a mouse button, say
    std::vector<std::string> known;
    for (const Named& other : kOthers) {
        if (other.name == rest) return chord | other.key;
        known.emplace_back(other.name);
    }
    for (int key = ImGuiKey_NamedKey_BEGIN; key < ImGuiKey_GamepadStart; ++key) {
        known.push_back(lowerCase(ImGui::GetKeyName(static_cast<ImGuiKey>(key))));
        if (known.back() == rest) return chord | key;
    }
    throw engine::Error(pointer, unknownName("unknown key", rest, known));
}

}  // namespace benchmarks
