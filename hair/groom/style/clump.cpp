#include "hair/groom/style/style.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>

#include <glm/geometric.hpp>

#include "hair/groom/style/along_strand.h"
#include "hair/random.h"

namespace hair {
namespace {

// Centre strands by the place of their root, in cubes as wide as the distance between centres.
class Centres {
public:
    Centres(const Groom& groom, double spacing) : groom_(groom), spacing_(spacing) {}

    void add(std::uint32_t strand) { cubes_[cube(strand)].push_back(strand); }

    // The nearest to a strand's root, if one is nearer than the spacing.
    std::optional<std::uint32_t> nearest(std::uint32_t strand) const {
        std::optional<std::uint32_t> found;
        double least = spacing_;
        const Cube home = cube(strand);
        for (int neighbour = 0; neighbour < 27; ++neighbour) {
            const auto at = cubes_.find(
                {home.x + neighbour % 3 - 1, home.y + neighbour / 3 % 3 - 1,
                 home.z + neighbour / 9 - 1});
            if (at == cubes_.end()) continue;
            for (const std::uint32_t centre : at->second) {
                const double distance = glm::distance(root(centre), root(strand));
                if (distance >= least) continue;
                least = distance;
                found = centre;
            }
        }
        return found;
    }

private:
    struct Cube {
        int x, y, z;
        friend bool operator==(const Cube&, const Cube&) = default;
    };
    struct CubeHash {
        std::size_t operator()(const Cube& cube) const {
            return hash(
                static_cast<std::uint32_t>(cube.x), static_cast<std::uint32_t>(cube.y),
                static_cast<std::uint32_t>(cube.z));
        }
    };

    glm::dvec3 root(std::uint32_t strand) const { return groom_.strand(strand).front(); }

    Cube cube(std::uint32_t strand) const {
        static constexpr double kLimit = 1e9;  // what lies further out shares the last cube
        const glm::dvec3 place = glm::floor(root(strand) / spacing_);
        const auto whole = [](double x) {
            return static_cast<int>(std::clamp(x, -kLimit, kLimit));
        };
        return {whole(place.x), whole(place.y), whole(place.z)};
    }

    const Groom& groom_;
    double spacing_;
    std::unordered_map<Cube, std::vector<std::uint32_t>, CubeHash> cubes_;
};

// The centre of each strand's clump; a centre's own is itself. Centres are taken greedily, in the
// order of a hash, wherever none is nearer than the spacing yet.
std::vector<std::uint32_t> clumpCentres(const Groom& groom, double spacing, std::uint32_t seed) {
    std::vector<std::uint32_t> order(groom.strand_count);
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [seed](std::uint32_t strand) {
        return std::pair(hash(seed, strand, purpose::clump_centre), strand);
    });
    Centres centres(groom, spacing);
    for (const std::uint32_t strand : order)
        if (!centres.nearest(strand)) centres.add(strand);
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) order[i] = centres.nearest(i).value();
    return order;
}

}  // namespace

Groom clump(Groom groom, const ClumpSettings& settings, std::uint32_t seed) {
    if (settings.strength == 0.0f) return groom;
    const std::vector<std::uint32_t> centres = clumpCentres(groom, settings.spacing, seed);
    const std::size_t vertices = groom.vertices_per_strand;
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand) {
        if (centres[strand] == strand) continue;
        const AlongStrand along(groom.strand(strand));
        const std::span<const glm::vec3> centre = groom.strand(centres[strand]);
        for (std::size_t i = 0; i < vertices; ++i) {
            const double share = settings.strength * ease(settings.start, 1.0, along.fraction(i));
            glm::vec3& point = groom.points[strand * vertices + i];
            point = glm::vec3(glm::mix(glm::dvec3(point), glm::dvec3(centre[i]), share));
        }
    }
    return groom;
}

}  // namespace hair
