#include "engine/memory_ledger.h"

namespace engine {

void MemoryLedger::leave(const Entry& entry, std::uint64_t bytes) {
    const auto place = bytes_.find(entry);
    if (place == bytes_.end()) return;
    place->second -= bytes;
    if (place->second == 0) bytes_.erase(place);
}

}  // namespace engine
