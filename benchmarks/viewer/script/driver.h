#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <string>

#include "benchmarks/viewer/script/user_input.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/ui_items.h"

namespace benchmarks {

// What the steps of a script act on. One that takes several pictures of the window says what
// comes before each of them.
class Driver {
public:
    explicit Driver(Viewer& shown) : viewer(shown) {}

    Viewer& viewer;
    engine::UiItems items;
    UserInput input;

    // Before the next picture, or after those that were asked for earlier.
    void then(std::function<void()> act);
    // Pictures with nothing new.
    void wait(int pictures);
    // So many that everything has answered: the settings are followed, then drawn, then shown.
    void settle() { wait(3); }
    // Pictures until `holds` is true, at most `pictures`: then engine::Error(`failure`).
    void until(std::function<bool()> holds, int pictures, const std::string& failure);

    // What comes before the next picture; false: nothing was asked for.
    bool goOn();

    // Throws engine::Error where there is none.
    const Side& side(std::size_t index) const;

private:
    std::deque<std::function<bool()>> acts_;  // before a picture; true: it was the last one
};

}  // namespace benchmarks
