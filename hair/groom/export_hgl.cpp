#include "hair/groom/export_hgl.h"

#include <bit>
#include <cassert>
#include <fstream>

#include "engine/error.h"

namespace hair {
namespace {

static_assert(
    std::endian::native == std::endian::little, "the file is written as it lies in memory");
static_assert(sizeof(glm::vec3) == 12 && sizeof(std::array<std::uint32_t, 3>) == 12);

template <class Element>
void write(std::ofstream& file, std::span<const Element> elements) {
    file.write(
        reinterpret_cast<const char*>(elements.data()),
        static_cast<std::streamsize>(elements.size_bytes()));
}

}  // namespace

void exportHgl(const Groom& groom, const std::filesystem::path& path) {
    if (groom.strand_count < 1) throw engine::Error(path.string(), "the groom has no strands");
    if (groom.vertices_per_strand < 2 || groom.vertices_per_strand > 256) {
        throw engine::Error(
            path.string(),
            std::to_string(groom.vertices_per_strand) + " vertices per strand is outside [2, 256]");
    }
    assert(groom.points.size() == std::size_t{groom.strand_count} * groom.vertices_per_strand);
    const std::array<std::uint32_t, 3> header{
        groom.strand_count, groom.segmentsPerStrand(),
        static_cast<std::uint32_t>(groom.root_triangles.size())};
    std::ofstream file(path, std::ios::binary);
    write<std::uint32_t>(file, header);
    write<glm::vec3>(file, groom.points);
    write<std::array<std::uint32_t, 3>>(file, groom.root_triangles);
    file.close();
    if (!file) throw engine::Error(path.string(), "can't be written");
}

}  // namespace hair
