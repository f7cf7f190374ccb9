#pragma once

#include <memory>

#include "engine/image.h"
#include "engine/ui.h"

namespace benchmarks {

// A picture that widgets can show, pixel by pixel as it was drawn.
class ShownPicture {
public:
    explicit ShownPicture(const engine::Device& device) : device_(device) {}

    // Records the copy of what was drawn. The device must be done with the last one.
    void copy(engine::Commands& commands, const engine::Image& output);

    // The image, of that size and with undefined contents, for who records into it instead and
    // leaves it in SHADER_READ_ONLY_OPTIMAL. The device must be done with the last one.
    const engine::Image& renew(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage);

    bool isThere() const { return shown_ != nullptr; }
    const engine::Image& image() const { return shown_->image; }
    ImTextureID id() const { return shown_->texture.id(); }
    VkExtent2D extent() const { return shown_->image.extent(); }

private:
    struct Shown {
        Shown(const engine::Device& device, const engine::ImageDescription& description)
            : image(device, description), texture(device, image) {}
        engine::Image image;
        engine::Ui::Texture texture;
    };

    const engine::Device& device_;
    std::unique_ptr<Shown> shown_;
    // Of another size: widgets that are about to be drawn still show it.
    std::unique_ptr<Shown> retired_;
};

}  // namespace benchmarks
