#pragma once

#include <optional>

namespace engine {

// What all threads of this process have used of the CPU: on a software device, what passes cost
// whoever else is at work on the machine.
struct ProcessUse {
    double cpu = 0.0;  // ms
    std::optional<double>
        instructions;  // retired in user mode; absent where no counter is to be had
};

ProcessUse operator-(const ProcessUse& to, const ProcessUse& from);
ProcessUse operator+(const ProcessUse& a, const ProcessUse& b);

// Since some moment in the past. Instructions are those of the thread that calls first and of every
// thread that starts after that, under it: call it before the device is made, which starts threads.
ProcessUse processUse();

}  // namespace engine
