#pragma once

#include <functional>
#include <vector>

#include "benchmarks/viewer/shell/action.h"

namespace benchmarks {

// How an action is shown.
struct ActionState {
    bool checked = false;
    bool enabled = true;
};

// The window's menu, made from the table of actions; those that were chosen. `state` is asked about
// the ones that are seen.
std::vector<Action> menuBar(const std::function<ActionState(Action)>& state);

}  // namespace benchmarks
