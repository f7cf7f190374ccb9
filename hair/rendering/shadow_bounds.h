#pragma once

#include "hair/rendering/render_assets.h"
#include "hair/rendering/strand_bounds.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// The least sphere round both; one of no radius is none.
Sphere enclosing(const Sphere& a, const Sphere& b);

// What lights look at.
struct ShadowBounds {
    Sphere seen;  // a light's map shows all of it: the hair and the head
    Sphere range;  // a light's map reaches from its near to its far end: all that is drawn
};

// Where things are in a picture.
class ShadowScene {
public:
    ShadowScene(const Settings& settings, const RenderAssets& assets);

    // With the head and the hair where `view` has them.
    ShadowBounds bounds(const StrandView& view) const;

private:
    Sphere head_;  // before it moved
    Sphere others_;
};

}  // namespace hair
