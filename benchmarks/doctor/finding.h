#pragma once

#include <string>

namespace benchmarks {

enum class Health {
    ok,
    unknown,  // the machine does not tell
    warn,     // timings can be used, with care
    bad,      // they can't be trusted
};

// "ok", "not told", "warn", "bad".
const char* healthName(Health health);

struct Finding {
    std::string check;  // name of the row
    Health health = Health::ok;
    std::string seen;
    std::string advice;  // what to do about it; empty: nothing
};

}  // namespace benchmarks
