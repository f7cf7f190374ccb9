#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/viewer/picture_area.h"
#include "hair/settings.h"

namespace benchmarks::viewer {

// One of several buttons of which one is pressed in.
template <class Value>
struct Choice {
    const char* label;
    Value value;
    const char* help;
};

enum class Chosen { no, yes };

// On the same line as the item before where there is room, else on the next one.
void sameLineIfItFits(const char* label);
bool choiceButton(const char* label, const char* help, Chosen chosen);

// In one line, or as many as they take.
template <class Value>
void choiceButtons(std::span<const Choice<Value>> choices, Value& value) {
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const Choice<Value>& choice = choices[i];
        if (i > 0) sameLineIfItFits(choice.label);
        const Chosen chosen = choice.value == value ? Chosen::yes : Chosen::no;
        if (choiceButton(choice.label, choice.help, chosen)) value = choice.value;
    }
}

// What the user wants of the two sides.
enum class CompareWish {
    nothing,
    start,  // a second side, equal to the first
    stop,   // a alone
    swap,
    copy_a_to_b,  // a's settings
};

// Everything about comparing two settings: how their pictures are shown, and what differs.
class ComparePanel {
public:
    int edited = 0;           // the side that the settings panel changes; 0: a, 1: b
    bool same_camera = true;  // what the mouse does to one picture's camera, it does to both

    // Within the current window of Dear ImGui. `b` is null while nothing is compared.
    CompareWish show(PictureArea& area, const hair::Settings& a, const hair::Settings* b);
};

// A field that two settings have different values of.
struct SettingDifference {
    std::string pointer;  // JSON pointer: /strands/density
    std::string a;        // as JSON, on one line; empty: it has none
    std::string b;

    bool operator==(const SettingDifference&) const = default;
};

// In the order of scene files. Numbers of one vector are one value; members of a list are compared
// one by one.
std::vector<SettingDifference>
settingsDifferences(const hair::Settings& a, const hair::Settings& b);

}  // namespace benchmarks::viewer
