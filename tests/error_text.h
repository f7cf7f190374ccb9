#pragma once

#include <string>

#include "engine/error.h"

// The one line that `action` fails with; "no error" if it doesn't.
template <class Action>
std::string errorText(Action&& action) {
    try {
        action();
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "no error";
}
