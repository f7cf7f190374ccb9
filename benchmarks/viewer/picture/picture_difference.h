#pragma once

#include <cstdint>
#include <optional>

#include "benchmarks/viewer/picture/difference_pass.h"
#include "benchmarks/viewer/picture/shown_picture.h"

namespace benchmarks {

// The difference of two pictures that are shown, as one that can be shown too.
class PictureDifference {
public:
    explicit PictureDifference(const engine::Device& device) : pass_(device), picture_(device) {}

    // Of pictures of one size whose copies were recorded before. The device must be done with the
    // last one.
    void record(
        engine::Commands& commands, const ShownPicture& a, const ShownPicture& b,
        std::uint32_t gain);

    // Nothing is to be known of the last one any more.
    void forget();

    bool isThere() const { return recorded_; }
    const ShownPicture& picture() const { return picture_; }
    // Of the picture before the last one, which the device is done with.
    const std::optional<DifferenceFigures>& figures() const { return figures_; }

private:
    DifferencePass pass_;
    ShownPicture picture_;
    bool recorded_ = false;
    std::optional<DifferenceFigures> figures_;
};

}  // namespace benchmarks
