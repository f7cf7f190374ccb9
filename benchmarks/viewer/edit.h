#pragma once

namespace benchmarks {

// What widgets or the mouse did to settings in one frame of the window.
struct Edit {
    bool changed = false;    // they are other ones now
    bool continues = false;  // and go on changing: something is being dragged

    Edit& operator|=(const Edit& other) {
        changed |= other.changed;
        continues |= other.continues;
        return *this;
    }
};

}  // namespace benchmarks
