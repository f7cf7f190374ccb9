#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/pictures.h"
#include "engine/presenter.h"

typedef void* ImTextureID;

// The user interface: Dear ImGui in a window, the widgets of its last frame, and its font for
// pictures.
struct ImFontAtlas;
struct ImGuiWindow;

namespace engine {

// Dear ImGui in a window: its context, fonts, input and drawing. One at a time. It keeps nothing on
// disk.
class Ui {
public:
    // `scale`: of the font, 1 on a usual screen. Colours and sizes come from ImGui::GetStyle().
    Ui(const Device& device, const Window& window, float scale);
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    // Widgets are made between begin() and end().
    void begin();
    void end();

    // Draws the widgets. Call it while rendering to Presenter::kFormat.
    void draw(Commands& commands);

    float scale() const { return scale_; }
    // Changes the font size from the next frame on. Not between begin() and end().
    void setScale(float scale);

    // An image for ImGui::Image, sampled in SHADER_READ_ONLY_OPTIMAL. The image must outlive it.
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
    void makeFont();

    const Device& device_;
    const Window& window_;
    float scale_ = 1.0f;
    Handle<VkDescriptorPool, &vkDestroyDescriptorPool> descriptors_;
};

// Draws lines of text into pictures, with the font of the user interface. Needs no window.
class TextPainter {
public:
    explicit TextPainter(float size);  // font height, px
    ~TextPainter();
    TextPainter(const TextPainter&) = delete;
    TextPainter& operator=(const TextPainter&) = delete;

    // Width of a line, px. Characters that the font lacks become "?".
    float width(std::string_view text) const;
    // Draws from the top left corner of the first letter. Parts outside the picture are left out.
    void draw(
        Pixels& picture, float left, float top, std::string_view text,
        const std::array<std::uint8_t, 3>& color) const;

private:
    std::unique_ptr<ImFontAtlas> atlas_;
};

// Returns a Dear ImGui window's name as in UiItem::window.
std::string windowName(const ImGuiWindow& window);

// A part of the window, px from its top left corner.
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
    std::string window;  // its window, with the parents of that: "Scene/fields"; a panel's own name
    std::string label;  // as passed to Dear ImGui, with "##"; empty: none
    UiRect rect;  // reacts to the mouse
    UiRect whole;  // includes a label beside the widget
    UiRect clip;  // area in which the widget is visible
    bool is_window = false;
    bool visible = false;  // at least in part
    bool scrolls = false;  // its window scrolls vertically
    bool enabled = true;
    bool inputable = false;  // takes text or numbers
    bool checkable = false;
    bool checked = false;
    bool openable = false;
    bool open = false;

    // The visible label: the part before "##".
    std::string text() const { return label.substr(0, label.find("##")); }
};

// The widgets in the last frame of Dear ImGui's current context, in the order of their creation,
// for scripts that find widgets as users do. Dear ImGui has no extra cost without an instance. Must
// not outlive the context.
class UiItems {
public:
    UiItems();
    ~UiItems();
    UiItems(const UiItems&) = delete;
    UiItems& operator=(const UiItems&) = delete;

    // Widgets scrolled out of sight have no label.
    const std::vector<UiItem>& items() const { return items_; }

    // For Dear ImGui's hooks, ImGuiTestEngineHook_*.
    void add(int frame, UiItem item);
    UiItem* find(std::uint32_t id);
    int frame() const { return frame_; }

    // Properties that Dear ImGui reports before it adds the widget.
    UiItem& early(std::uint32_t id);

private:
    int frame_ = -1;
    std::vector<UiItem> items_;
    UiItem early_;
};

}  // namespace engine
