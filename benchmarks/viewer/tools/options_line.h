#pragma once

namespace benchmarks {

// Widgets in a line that goes on in the next one where the window has no more room.
class OptionsLine {
public:
    // True when it was pressed; one that is not enabled is gray.
    bool button(const char* name, bool enabled, const char* tooltip);

    // One of several: that which is chosen looks pressed.
    enum class Choice { open, chosen };
    bool choice(const char* name, Choice choice, const char* tooltip);

    // True while it is another value. Ctrl+click takes a number beyond the slider's ends.
    bool slider(const char* name, float& value, float minimum, float maximum, const char* format);

    // Between groups of widgets that are in one line.
    void separator();

private:
    // Where the next widget is, which has this width, px.
    void place(float width);

    bool is_empty_ = true;
    bool separates_ = false;  // what is placed next from what is there
};

}  // namespace benchmarks
