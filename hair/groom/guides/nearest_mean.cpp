#include "hair/groom/guides/nearest_mean.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace hair {
namespace {

// How much the points' own square distances count beside that of their mean. They are lifted to a
// paraboloid by it, whose lower hull over a plane is the Delaunay triangulation. At 1e-6 a mean may
// be further off by 1e-3 of the distance to the points, where that gives a smaller triangle.
constexpr double kNearness = 1e-6;

// Triangles thinner than this have no solution that rounding leaves anything of; their edges do.
constexpr double kFlat = 1e-12;

class Search {
public:
    explicit Search(const Products& products) : products_(products) {}

    void tryPoint(std::size_t i) { offer({i, i, i}, {1.0, 0.0, 0.0}); }

    void tryEdge(std::size_t i, std::size_t j) {
        const double size = edges(i, j, j);
        if (size <= 0.0) return;
        const double along = -fromFirst(i, j) / size;
        if (along > 0.0 && along < 1.0) offer({i, j, i}, {1.0 - along, along, 0.0});
    }

    // Normal equations of the plane's two directions.
    void tryTriangle(std::size_t i, std::size_t j, std::size_t k) {
        const double jj = edges(i, j, j);
        const double jk = edges(i, j, k);
        const double kk = edges(i, k, k);
        const double determinant = jj * kk - jk * jk;
        if (determinant <= kFlat * jj * kk) return;
        const double to_j = -fromFirst(i, j);
        const double to_k = -fromFirst(i, k);
        const double weight_j = (to_j * kk - to_k * jk) / determinant;
        const double weight_k = (to_k * jj - to_j * jk) / determinant;
        const double weight_i = 1.0 - weight_j - weight_k;
        if (weight_i > 0.0 && weight_j > 0.0 && weight_k > 0.0)
            offer({i, j, k}, {weight_i, weight_j, weight_k});
    }

    const Mean& best() const { return best_; }

private:
    // (j - i) . (k - i)
    double edges(std::size_t i, std::size_t j, std::size_t k) const {
        const auto& of = products_.of;
        return of[j][k] - of[i][j] - of[i][k] + of[i][i];
    }
    // (j - i) . i
    double fromFirst(std::size_t i, std::size_t j) const {
        return products_.of[i][j] - products_.of[i][i];
    }

    void offer(const std::array<std::size_t, 3>& members, const std::array<double, 3>& weights) {
        double square = 0.0;
        double squares = 0.0;
        for (std::size_t a = 0; a < 3; ++a) {
            for (std::size_t b = 0; b < 3; ++b)
                square += weights[a] * weights[b] * products_.of[members[a]][members[b]];
            squares += weights[a] * products_.of[members[a]][members[a]];
        }
        const double cost = square + kNearness * squares;
        if (cost >= cost_) return;
        cost_ = cost;
        best_ = {members, weights};
    }

    const Products& products_;
    Mean best_;
    double cost_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Mean nearestMean(const Products& products) {
    Search search(products);
    for (std::size_t i = 0; i < products.count; ++i) {
        search.tryPoint(i);
        for (std::size_t j = 0; j < i; ++j) {
            search.tryEdge(i, j);
            for (std::size_t k = 0; k < j; ++k) search.tryTriangle(i, j, k);
        }
    }
    const Mean& best = search.best();
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(
        order, std::greater<>(), [&](std::size_t i) { return best.weights[i]; });
    Mean sorted;
    for (std::size_t i = 0; i < 3; ++i) {
        sorted.weights[i] = best.weights[order[i]];
        sorted.members[i] = best.members[sorted.weights[i] > 0.0 ? order[i] : order[0]];
    }
    return sorted;
}

}  // namespace hair
