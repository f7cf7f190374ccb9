#include "benchmarks/interrupt.h"

#include <csignal>

namespace benchmarks {

namespace {

volatile std::sig_atomic_t interrupt_count = 0;  // a signal handler can reach nothing but a global

extern "C" void onInterrupt(int signal) {
    interrupt_count = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    std::signal(SIGHUP, onInterrupt);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return interrupt_count != 0; }

void checkInterrupted() {
    if (interrupted()) throw Interrupted();
}

}  // namespace benchmarks
