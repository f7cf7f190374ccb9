#include "hair/rendering/backends.h"

namespace hair {

namespace {

class EmptyBackend : public StrandBackend {
public:
    void
    draw(engine::Commands&, std::uint64_t, std::span<const engine::SampledImage>) const override {}

    std::optional<ExpectedCounts> expected() const override { return std::nullopt; }
};

}  // namespace

std::unique_ptr<StrandBackend> makeEmptyBackend() { return std::make_unique<EmptyBackend>(); }

}  // namespace hair
