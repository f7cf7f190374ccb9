#include "benchmarks/viewer/picture/picture_difference.h"

#include "engine/commands.h"

namespace benchmarks {

using engine::Access;

void PictureDifference::record(
    engine::Commands& commands, const ShownPicture& a, const ShownPicture& b, std::uint32_t gain) {
    if (recorded_) figures_ = pass_.figures();
    const engine::Image& image =
        picture_.renew(VK_FORMAT_R8G8B8A8_UNORM, a.extent(), VK_IMAGE_USAGE_STORAGE_BIT);
    commands.transition(
        image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, Access::anything,
        Access::compute_write);
    pass_.record(commands, a.image(), b.image(), image, gain);
    commands.transition(
        image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        Access::compute_write, Access::graphics_read);
    recorded_ = true;
}

void PictureDifference::forget() {
    recorded_ = false;
    figures_.reset();
}

}  // namespace benchmarks
