#include "benchmarks/viewer/script/user_input.h"

#include <utility>

#include <imgui.h>
#include <imgui_internal.h>

namespace benchmarks {

namespace {

constexpr float kPictureTime = 1.0f / 60.0f;  // s

}  // namespace

UserInput::UserInput() {
    ImGuiContext* const context = ImGui::GetCurrentContext();
    ImGuiContextHook hook;
    hook.Type = ImGuiContextHookType_NewFramePre;
    hook.Callback = &UserInput::feed;
    hook.UserData = this;
    hook_ = ImGui::AddContextHook(context, &hook);
    // Else what is called between two pictures is spread over more of them, and the rest dropped.
    trickles_ = std::exchange(ImGui::GetIO().ConfigInputTrickleEventQueue, false);
}

UserInput::~UserInput() {
    ImGui::RemoveContextHook(ImGui::GetCurrentContext(), hook_);
    ImGui::GetIO().ConfigInputTrickleEventQueue = trickles_;
}

// After GLFW's back end has added what it knows, and before Dear ImGui looks at it.
void UserInput::feed(ImGuiContext* context, ImGuiContextHook* hook) {
    auto& self = *static_cast<UserInput*>(hook->UserData);
    ImGuiIO& io = context->IO;
    io.ClearEventsQueue();
    io.DeltaTime = kPictureTime;
    for (const auto& event : std::exchange(self.events_, {})) event(io);
}

void UserInput::move(float x, float y) {
    events_.emplace_back([=](ImGuiIO& io) { io.AddMousePosEvent(x, y); });
}

void UserInput::button(int button, Change change) {
    events_.emplace_back(
        [=](ImGuiIO& io) { io.AddMouseButtonEvent(button, change == Change::press); });
}

void UserInput::wheel(float x, float y) {
    events_.emplace_back([=](ImGuiIO& io) { io.AddMouseWheelEvent(x, y); });
}

void UserInput::key(int chord, Change change) {
    const bool down = change == Change::press;
    events_.emplace_back([=](ImGuiIO& io) {
        for (const int modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt, ImGuiMod_Super})
            if (chord & modifier) io.AddKeyEvent(static_cast<ImGuiKey>(modifier), down);
        const auto key = static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_);
        if (key != ImGuiKey_None) io.AddKeyEvent(key, down);
    });
}

void UserInput::type(const std::string& text) {
    events_.emplace_back([=](ImGuiIO& io) { io.AddInputCharactersUTF8(text.c_str()); });
}

}  // namespace benchmarks
