// Every row of the table, on the device and by the reference.
//
// A mean may miss by 4.5 standard errors and the roundings of its row; the same data must reject
// what is off by as much as the row is meant to resolve: 5 %, or 100 times its roundings where
// there is no noise.
#include "device/device_test.h"
#include "stability/rows.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace tyndall::selftest {
void PrintTo(const Case& c, std::ostream* to) {
    *to << c.name;
}
} // namespace tyndall::selftest

namespace tyndall::stability {
namespace {

using selftest::Case;
using support::Estimate;

void expect_row(const Case& c, const Estimate& mean) {
    for (int k = 0; k < 3; ++k) {
        const double rounding = c.rounding * c.expected[k];
        const double allowed = support::pass * mean.standard_error[k] + rounding;
        EXPECT_LE(std::abs(mean.mean[k] - c.expected[k]), allowed)
            << "channel " << k << ": " << mean.mean[k] << " +- " << mean.standard_error[k]
            << ", not " << c.expected[k];
        const double off = std::max(0.05 * c.expected[k], 100 * rounding);
        EXPECT_TRUE(c.expected[k] == 0 || off > support::reject * mean.standard_error[k] + rounding)
            << "no teeth in channel " << k << ": +- " << mean.standard_error[k];
    }
}

class Rows : public device_test::DeviceTest, public testing::WithParamInterface<Case> {};

TEST_P(Rows, AreRightOnTheDevice) {
    expect_row(GetParam(), device_test::mean_of(GetParam().scene, GetParam().samples));
}

/// The longer tier: a hundred times the samples, by which errors are resolved that are ten times
/// smaller.
class LongRows : public Rows {};

TEST_P(LongRows, AreRightAHundredTimesDeeper) {
    const Case& c = GetParam();
    expect_row(c, device_test::mean_of(c.scene, 100 * std::min(c.samples, 4096u)));
}

/// The reference is slower, and has double precision: the means of 16 batches, some ten times
/// fewer samples.
class ReferenceRows : public testing::TestWithParam<Case> {};

TEST_P(ReferenceRows, AreRight) {
    const Case& c = GetParam();
    constexpr std::uint32_t batches = 16;
    const auto each = std::clamp<std::uint32_t>(c.samples / (10 * batches), 1, 16);
    const Estimate mean = support::image_mean(c.scene, batches, each);
    for (int k = 0; k < 3; ++k)
        EXPECT_LE(std::abs(mean.mean[k] - c.expected[k]),
                  support::pass * mean.standard_error[k] + c.rounding * c.expected[k])
            << "channel " << k << ": " << mean.mean[k] << " +- " << mean.standard_error[k]
            << ", not " << c.expected[k];
}

const auto name_of = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Known, Rows, testing::ValuesIn(rows()), name_of);
INSTANTIATE_TEST_SUITE_P(Known, ReferenceRows, testing::ValuesIn(rows()), name_of);
INSTANTIATE_TEST_SUITE_P(Deep, LongRows, testing::ValuesIn(rows()), name_of);

} // namespace
} // namespace tyndall::stability
