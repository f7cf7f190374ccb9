#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/strand_format.h"

// NumPy's arrays (numpy.lib.format, versions 1.0 to 3.0), which have no unit:
//   .npy  one array of shape (strands, points of each, 3)
//   .npz  a zip archive of arrays by name, stored or deflated (PKWARE, APPNOTE 6.3.10; no ZIP64, no
//         encryption). Its arrays are those of DiffLocks (Rosu et al. 2025),
//           positions (strands, points, 3), root_uv (strands, 2)
//         and, of hairbench,
//           widths (strands, points), groups (strands), guides (strands), 0 or 1
//         Without `positions`, the only array of its shape is read.
// Numbers are little-endian: float32 or float64, groups int32 or int64, guides uint8 or bool.
// Arrays are in C's order or in Fortran's.
namespace hair::groom {

enum class NpyType : std::uint8_t { float32, float64, int32, int64, uint8, boolean };

// Returns the beginning of a .npy file of numbers in C's order, which follow. It has a multiple of
// 64 bytes, so that the numbers can be mapped.
std::string npyHeader(NpyType type, std::span<const std::uint64_t> shape);

// Writes a .npz archive whose numbers come in parts, so that no array is ever in memory whole.
// Always ZIP64, so arrays and archive may be larger than 4 GiB; checksums follow their arrays, so
// that a pipe will do. importNpz() does not read it.
class NpzStream {
public:
    explicit NpzStream(std::ostream& out) : out_(out) {}

    // Begins an array, after the end of the one before.
    void begin(std::string_view key, NpyType type, std::span<const std::uint64_t> shape);
    // Numbers of the array that was begun.
    void append(std::span<const std::byte> numbers);
    // Ends the archive.
    void finish();

private:
    void endArray();
    void write(std::string_view bytes);

    std::ostream& out_;
    std::uint64_t position_ = 0;
    std::string directory_;
    std::uint64_t members_ = 0;
    // The array that was begun; no name: there is none.
    std::string name_;
    std::uint64_t start_ = 0;
    std::uint64_t size_ = 0;
    std::uint32_t checksum_ = 0;
};

// Strands with differing numbers of points are resampled to the greatest of them, with a warning.
// Numbers are float32, int32 and uint8, in C's order; nothing is deflated. Both return what is
// left out. Both throw engine::Error if there are no strands, or an array has 4 GiB or more.
std::vector<std::string> exportNpy(const StrandSet& strands, std::ostream& out);
std::vector<std::string> exportNpz(const StrandSet& strands, std::ostream& out);

// Arrays of other names, such as DiffLocks' root_normal, are left out with a warning. Both refuse
// files that are not exactly of the format: other types and shapes, arrays not as long as their
// header says (checked before any allocation), wrong checksums. Both throw engine::Error "byte N:
// reason".
StrandSet importNpy(const StrandFile& file);
StrandSet importNpz(const StrandFile& file);

}  // namespace hair::groom
