#pragma once

#include <string>

#include "engine/error.h"

// Returns the one-line error that `action` throws, or "no error".
template <class Action>
std::string errorText(Action&& action) {
    try {
        action();
    } catch (const engine::Error& error) {
        return error.what();
    }
    return "no error";
}
