#pragma once

#include <functional>

#include <imgui.h>

// Dear ImGui without a window or a device: draws and discards.
class HeadlessUi {
public:
    HeadlessUi(float width, float height) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {width, height};
        io.Fonts->Build();
        io.Fonts->SetTexID(&texture_);
    }
    ~HeadlessUi() { ImGui::DestroyContext(); }
    HeadlessUi(const HeadlessUi&) = delete;
    HeadlessUi& operator=(const HeadlessUi&) = delete;

    // Shows several pictures, because panels with automatic size need two.
    void show(const std::function<void()>& widgets, int pictures = 3) {
        for (int i = 0; i < pictures; ++i) {
            ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
            ImGui::NewFrame();
            widgets();
            ImGui::Render();
        }
    }

private:
    int texture_ = 0;  // stands for the font's texture
};
