#pragma once

namespace benchmarks {

// From here on Ctrl-C, termination and a closed terminal are remembered instead of ending the
// program; a second one ends it. A limit on the size of files becomes an error of who writes.
void catchInterrupts();

// Whether one came.
bool interrupted();

// What ends work that is interrupted.
class Interrupted {};

// Throws it where one came.
void checkInterrupted();

}  // namespace benchmarks
