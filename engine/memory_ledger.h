#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <utility>

namespace engine {

// Bytes of device memory by the names of the buffers and images that hold them and by the memory
// heap that they lie in. Live allocations only.
class MemoryLedger {
public:
    struct Entry {
        std::uint32_t heap = 0;  // of VkPhysicalDeviceMemoryProperties
        bool device_local = false;
        std::string name;  // of the buffer or image

        auto operator<=>(const Entry&) const = default;
    };

    const std::map<Entry, std::uint64_t>& bytes() const { return bytes_; }

    // Once on the ledger, off it again when the entry's owner goes; move-only.
    class Line {
    public:
        Line() = default;
        Line(MemoryLedger& ledger, Entry entry, std::uint64_t bytes)
            : ledger_(&ledger), entry_(std::move(entry)), bytes_(bytes) {
            ledger_->enter(entry_, bytes_);
        }
        Line(Line&& other) noexcept { swap(other); }
        Line& operator=(Line&& other) noexcept {
            swap(other);
            return *this;
        }
        ~Line() {
            if (ledger_) ledger_->leave(entry_, bytes_);
        }

    private:
        void swap(Line& other) noexcept {
            std::swap(ledger_, other.ledger_);
            std::swap(entry_, other.entry_);
            std::swap(bytes_, other.bytes_);
        }

        MemoryLedger* ledger_ = nullptr;
        Entry entry_;
        std::uint64_t bytes_ = 0;
    };

private:
    void enter(const Entry& entry, std::uint64_t bytes) { bytes_[entry] += bytes; }
    void leave(const Entry& entry, std::uint64_t bytes);

    std::map<Entry, std::uint64_t> bytes_;
};

}  // namespace engine
