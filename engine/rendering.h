#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/commands.h"

namespace engine {

enum class Load { clear, keep };

// An image that is rendered to; color or depth attachment layout.
struct Attachment {
    const Image* image;
    Load load = Load::keep;
    std::array<float, 4> clear{};  // color; of depth the first
};

// Begins rendering to attachments of one size. The viewport is `area`, all of them by default;
// without attachments it has to be given.
void beginRendering(
    Commands& commands, std::span<const Attachment> colors, const std::optional<Attachment>& depth,
    const std::optional<VkRect2D>& area = std::nullopt);
void endRendering(Commands& commands);

}  // namespace engine
