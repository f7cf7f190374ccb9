#include "benchmarks/viewer/settings/text_input.h"

#include <imgui.h>

namespace benchmarks {

namespace {

// Makes room where Dear ImGui has more to write.
int resize(ImGuiInputTextCallbackData* data) {
    if (data->EventFlag != ImGuiInputTextFlags_CallbackResize) return 0;
    auto& text = *static_cast<std::string*>(data->UserData);
    text.resize(static_cast<std::size_t>(data->BufTextLen));
    data->Buf = text.data();
    return 0;
}

}  // namespace

bool textInput(const char* label, std::string& text, const char* hint) {
    return ImGui::InputTextWithHint(
        label, hint, text.data(), text.capacity() + 1, ImGuiInputTextFlags_CallbackResize, resize,
        &text);
}

}  // namespace benchmarks
