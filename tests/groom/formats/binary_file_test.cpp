#include "hair/groom/formats/binary_file.h"

#include <gtest/gtest.h>

#include "tests/groom/formats/bytes.h"

namespace hair::groom {
namespace {

TEST(FirstNotFinite, FindsEveryPlace) {
    // More than one block, so that the last block is not full.
    std::vector<float> numbers(4096 + 7, std::numeric_limits<float>::max());
    numbers[3] = std::numeric_limits<float>::denorm_min();
    numbers[4] = std::numeric_limits<float>::lowest();
    EXPECT_FALSE(firstNotFinite(numbers));
    EXPECT_FALSE(firstNotFinite({}));
    for (const float wrong : kNotFinite) {
        for (const std::size_t i : {0u, 1u, 4095u, 4096u, 4102u}) {
            const float kept = std::exchange(numbers[i], wrong);
            EXPECT_EQ(firstNotFinite(numbers), i);
            numbers[i] = kept;
        }
    }
}

}  // namespace
}  // namespace hair::groom
