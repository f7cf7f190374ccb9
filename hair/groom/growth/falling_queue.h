#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

namespace hair {

// Gives out the greatest of many entries whose weights only fall. Entries wait unsorted in bins by
// weight; only the highest bin is a heap.
class FallingQueue {
public:
    struct Entry {
        double weight;      // at least 0
        std::uint32_t tie;  // decides between equal weights
        std::uint32_t item;
        auto operator<=>(const Entry&) const = default;
    };

    explicit FallingQueue(std::vector<Entry> entries) : bins_(entries.size() / 256 + 1) {
        double most = 0.0;
        for (const Entry& entry : entries) most = std::max(most, entry.weight);
        if (most > 0.0) per_weight_ = static_cast<double>(bins_.size() - 1) / most;
        for (const Entry& entry : entries) bins_[bin(entry.weight)].push_back(entry);
        open_ = bins_.size() - 1;
        std::ranges::make_heap(bins_[open_]);
    }

    // Only of a queue that isn't empty. weightOf(item) is its weight now.
    template <class WeightOf>
    std::uint32_t pop(WeightOf&& weightOf) {
        while (true) {
            std::vector<Entry>& heap = bins_[open_];
            if (heap.empty()) {
                openNext(weightOf);
                continue;
            }
            std::ranges::pop_heap(heap);
            Entry entry = heap.back();
            heap.pop_back();
            const double weight = weightOf(entry.item);
            if (weight == entry.weight) return entry.item;
            entry.weight = weight;
            bins_[bin(weight)].push_back(entry);
            if (bin(weight) == open_) std::ranges::push_heap(heap);
        }
    }

private:
    std::size_t bin(double weight) const {
        return static_cast<std::size_t>(std::max(weight, 0.0) * per_weight_);
    }

    template <class WeightOf>
    void openNext(WeightOf&& weightOf) {
        --open_;
        std::vector<Entry> entries = std::exchange(bins_[open_], {});
        for (Entry& entry : entries) {
            entry.weight = weightOf(entry.item);
            bins_[bin(entry.weight)].push_back(entry);
        }
        std::ranges::make_heap(bins_[open_]);
    }

    std::vector<std::vector<Entry>> bins_;
    double per_weight_ = 0.0;
    std::size_t open_ = 0;
};

}  // namespace hair
