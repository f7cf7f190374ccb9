#pragma once

#include <string>

#include <gtest/gtest.h>

enum class Printed { to_stdout, to_stderr };

// Returns the output of `action`. If it throws, restores the stream and prints the output first.
// Otherwise the failure and all later tests would print into the capture.
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
