#pragma once

namespace benchmarks {

// From here on Ctrl-C and termination are remembered instead of ending the program; a second one
// ends it.
void catchInterrupts();

// Whether one came.
bool interrupted();

}  // namespace benchmarks
