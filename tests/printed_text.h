#pragma once

#include <string>

#include <gtest/gtest.h>

enum class Printed { to_stdout, to_stderr };

// Returns what `action` prints. Where it throws, prints that and gives the stream back first: else
// the failure itself, and all tests after it, would print into the capture.
template <class Action>
std::string printedText(Printed where, Action&& action) {
    const bool is_stdout = where == Printed::to_stdout;
    const auto captured = [&] {
        return is_stdout ? testing::internal::GetCapturedStdout()
                         : testing::internal::GetCapturedStderr();
    };
    if (is_stdout)
        testing::internal::CaptureStdout();
    else
        testing::internal::CaptureStderr();
    try {
        action();
    } catch (...) {
        ADD_FAILURE() << "printed before the exception: " << captured();
        throw;
    }
    return captured();
}
