#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <string_view>
#include <utility>

namespace benchmarks::scene {

// An LRU cache: values by key.
template <class Value>
class LruCache {
public:
    // `most_bytes` limits the size of all values together, but the last value is always kept.
    explicit LruCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    // Returns null if the key is absent. Valid until trim().
    const Value* find(std::string_view key) {
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
            if (entry->key != key) continue;
            entries_.splice(entries_.begin(), entries_, entry);
            return &entries_.front().value;
        }
        return nullptr;
    }

    // `bytes` is the approximate size of the value. The key must be new.
    const Value& add(std::string key, Value value, std::size_t bytes) {
        entries_.push_front({std::move(key), std::move(value), bytes});
        bytes_ += bytes;
        return entries_.front().value;
    }

    // Removes the least recently used values above the limit.
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
    std::list<Entry> entries_;  // most recently used first
};

}  // namespace benchmarks::scene
