#include "benchmarks/viewer/script/driver.h"

#include <utility>

#include "engine/error.h"

namespace benchmarks {

void Driver::then(std::function<void()> act) {
    acts_.emplace_back([act = std::move(act)] {
        act();
        return true;
    });
}

void Driver::wait(int pictures) {
    for (int i = 0; i < pictures; ++i) then([] {});
}

void Driver::until(std::function<bool()> holds, int pictures, const std::string& failure) {
    acts_.emplace_back([=, left = pictures]() mutable {
        if (holds()) return true;
        if (left-- == 0) throw engine::Error(failure);
        return false;
    });
}

bool Driver::goOn() {
    if (acts_.empty()) return false;
    if (acts_.front()()) acts_.pop_front();
    return true;
}

const Side& Driver::side(std::size_t index) const {
    if (index >= viewer.sideCount())
        throw engine::Error(
            "there is no side " + std::to_string(index) + "; the window shows " +
            std::to_string(viewer.sideCount()));
    return viewer.side(index);
}

}  // namespace benchmarks
