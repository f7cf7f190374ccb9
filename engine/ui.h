#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/presenter.h"

typedef void* ImTextureID;

// The user interface: Dear ImGui in a window, and the widgets that its last picture had.
struct ImGuiWindow;

namespace engine {

// Dear ImGui in a window: its context, letters, input and drawing. One at a time. Nothing of it is
// kept on disk.
class Ui {
public:
    // `scale` of letters: 1 on a usual screen. Colours and sizes are ImGui::GetStyle()'s.
    Ui(const Device& device, const Window& window, float scale);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    // Widgets are made between begin() and end().
    void begin();
    void end();

    // Draws the widgets; while rendering to Presenter::kFormat.
    void draw(Commands& commands);

    float scale() const { return scale_; }
    // Letters of another size, from the next picture on. Not between begin() and end().
    void setScale(float scale);

    // An image for ImGui::Image, which is sampled in SHADER_READ_ONLY_OPTIMAL and must live as
    // long.
    class Texture {
    public:
        Texture(const Device& device, const Image& image);
        ~Texture();
        Texture(const Texture&) = delete;
        Texture& operator=(const Texture&) = delete;
        ImTextureID id() const { return id_; }

    private:
        const Device& device_;
        Handle<VkSampler, &vkDestroySampler> sampler_;
        ImTextureID id_{};
    };

private:
    void makeLetters();

    const Device& device_;
    const Window& window_;
    float scale_ = 1.0f;
    Handle<VkDescriptorPool, &vkDestroyDescriptorPool> descriptors_;
};

// A window of Dear ImGui as UiItem::window has it.
std::string windowName(const ImGuiWindow& window);

// A part of the window's picture, px from its top left corner.
struct UiRect {
    float left = 0.0f;
    float top = 0.0f;
    float right = 0.0f;
    float bottom = 0.0f;

    float width() const { return right - left; }
    float height() const { return bottom - top; }
};

// A widget, or a whole panel.
struct UiItem {
    std::uint32_t id = 0;
    std::string
        window;  // the window it is in, with those around it: "Scene/fields"; a panel's own name
    std::string label;  // as it was given to Dear ImGui, "##" included; empty: it has none
    UiRect rect;  // where the mouse finds it
    UiRect whole;  // with its label, which may stand beside it
    UiRect clip;  // what is seen of it lies in here
    bool is_window = false;
    bool visible = false;  // at least in part
    bool scrolls = false;  // its window scrolls, up and down
    bool enabled = true;
    bool inputable = false;  // with letters or numbers
    bool checkable = false;
    bool checked = false;
    bool openable = false;
    bool open = false;

    // The label as people read it: what is before "##".
    std::string text() const { return label.substr(0, label.find("##")); }
};

// What widgets the last picture of Dear ImGui's current context had, in the order in which they
// were made: for scripts that look for them as users do. It costs nothing while there is none.
// Must not outlive the context.
class UiItems {
public:
    UiItems();
    ~UiItems();
    UiItems(const UiItems&) = delete;
    UiItems& operator=(const UiItems&) = delete;

    // Widgets that are scrolled out of sight have no label.
    const std::vector<UiItem>& items() const { return items_; }

    // For Dear ImGui's calls, ImGuiTestEngineHook_*.
    void add(int frame, UiItem item);
    UiItem* find(std::uint32_t id);
    int frame() const { return frame_; }

    // What Dear ImGui says of a widget before it adds the widget.
    UiItem& early(std::uint32_t id);

private:
    int frame_ = -1;
    std::vector<UiItem> items_;
    UiItem early_;
};

}  // namespace engine
