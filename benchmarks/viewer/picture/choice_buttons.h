#pragma once

#include <cstddef>
#include <span>

namespace benchmarks {

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

}  // namespace benchmarks
