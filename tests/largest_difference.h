#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <ranges>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

// Extremes and differences that keep NaN. std::max and std::min drop NaN, because comparisons with
// it are false. With them, a solver that writes only NaN would differ from its reference by 0.

// The least and the greatest of the added values. NaN, which fails every comparison, if any value
// is not finite. Throws without a value.
class Extremes {
public:
    void add(double value) {
        ++count_;
        all_finite_ = all_finite_ && std::isfinite(value);
        if (value < least_) least_ = value;
        if (value > greatest_) greatest_ = value;
    }

    double least() const { return checked(least_); }
    double greatest() const { return checked(greatest_); }

private:
    double checked(double value) const {
        if (count_ == 0) throw std::logic_error("there is no extreme of no values");
        return all_finite_ ? value : std::numeric_limits<double>::quiet_NaN();
    }

    std::size_t count_ = 0;
    bool all_finite_ = true;
    double least_ = std::numeric_limits<double>::infinity();
    double greatest_ = -std::numeric_limits<double>::infinity();
};

inline double differenceOf(double a, double b) { return std::abs(a - b); }

// Returns the length of the difference of two vectors.
template <glm::length_t kSize, class A, class B, glm::qualifier kQualifier>
double
differenceOf(const glm::vec<kSize, A, kQualifier>& a, const glm::vec<kSize, B, kQualifier>& b) {
    using Vector = glm::vec<kSize, double, kQualifier>;
    return glm::distance(Vector(a), Vector(b));
}

// Returns the largest difference between elements of the same index: numbers or vectors, of float
// or double. NaN if any is not finite. Throws if the lengths differ or are 0.
template <std::ranges::sized_range A, std::ranges::sized_range B>
double largestDifference(const A& a, const B& b) {
    if (std::ranges::size(a) != std::ranges::size(b))
        throw std::invalid_argument(
            "cannot compare " + std::to_string(std::ranges::size(a)) + " values with " +
            std::to_string(std::ranges::size(b)));
    if (std::ranges::empty(a)) throw std::invalid_argument("there are no values to compare");
    Extremes differences;
    auto other = std::ranges::begin(b);
    for (const auto& value : a) differences.add(differenceOf(value, *other++));
    return differences.greatest();
}
