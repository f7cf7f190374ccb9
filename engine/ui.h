#pragma once

#include "engine/presenter.h"

typedef void* ImTextureID;

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

    // Widgets are made between these two.
    void begin();
    void end();

    // Draws the widgets; while rendering to Presenter::kFormat.
    void draw(Commands& commands);

    float scale() const { return scale_; }
    // Letters of another size, from the next picture on. Not between begin() and end().
    void setScale(float scale);

    // For ImGui::Image; the image is sampled in SHADER_READ_ONLY_OPTIMAL. It must live as long.
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

}  // namespace engine
