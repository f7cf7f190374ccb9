#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <string_view>
#include <utility>

namespace benchmarks::scene {

// Values by key, of which the ones that were used last are kept.
template <class Value>
class Recent {
public:
    // Bytes of all values together; the last one may be more by itself.
    explicit Recent(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    // Null where it is not there. Valid until trim().
    const Value* find(std::string_view key) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
            if (entry->key != key) continue;
            entries_.splice(entries_.begin(), entries_, entry);
            return &entries_.front().value;
        }
        return nullptr;
    }

    // `bytes` is what the value takes, about. The key must be new.
    const Value& add(std::string key, Value value, std::size_t bytes) {
        entries_.push_front({std::move(key), std::move(value), bytes});
        bytes_ += bytes;
        return entries_.front().value;
    }

    // Lets go of what was used longest ago and is too much.
    void trim() {
        while (bytes_ > most_bytes_ && entries_.size() > 1) {
            bytes_ -= entries_.back().bytes;
            entries_.pop_back();
        }
    }

private:
    struct Entry {
        std::string key;
        Value value;
        std::size_t bytes;
    };

    std::size_t most_bytes_;
    std::size_t bytes_ = 0;
    std::list<Entry> entries_;  // used last first
};

}  // namespace benchmarks::scene
