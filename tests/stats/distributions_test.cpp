// Tail probabilities against values computed with 40 digits.
#include "stats/distributions.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace tyndall::stats {
namespace {

struct Known {
    double x, dof, p;
};

TEST(Distributions, StudentMatchesKnownValues) {
    for (const Known& k :
         {Known{0.5, 1, 0.70483276469913345}, Known{12.7062047364321, 1, 0.049999999998991285},
          Known{2, 7, 0.085619328562976077}, Known{1000, 7, 2.6409838375211876e-19},
          Known{8.4, 15, 4.6976638575535322e-7}, Known{40, 15, 1.1690661240866398e-16},
          Known{3, 15, 0.008972737477223329}, Known{0.001, 15, 0.99921529381382317},
          Known{5, 1000, 6.7672563646486304e-7}, Known{60, 31, 1.2308509339091375e-33},
          Known{1e10, 3, 2.2053155816871682e-30}, Known{30, 100000, 7.3785368722222337e-197},
          Known{2.5, 0.5, 0.40097052905329318}}) {
        // The normalisation is a difference of lgamma(dof / 2): that costs digits for many degrees.
        const double tolerance = 1e-12 + 1e-15 * k.dof * std::log(k.dof + 1);
        EXPECT_NEAR(student_two_sided(k.x, k.dof) / k.p, 1, tolerance) << k.x << ' ' << k.dof;
        EXPECT_EQ(student_two_sided(-k.x, k.dof), student_two_sided(k.x, k.dof));
    }
    EXPECT_EQ(student_two_sided(0, 5), 1);
    EXPECT_EQ(student_two_sided(std::numeric_limits<double>::infinity(), 5), 0);
}

TEST(Distributions, StudentQuantilesMatchKnownValues) {
    for (const Known& k : {Known{12.706204736432102, 1, 0.05}, Known{2.3646242510103, 7, 0.05},
                           Known{1.9623390808264078, 1000, 0.05},
                           Known{0.7850136812811753, 2.5, 0.5}, Known{130.15458935414782, 3, 1e-6}})
        EXPECT_NEAR(student_quantile(k.p, k.dof) / k.x, 1, 1e-8) << k.p << ' ' << k.dof;
}

TEST(Distributions, NormalMatchesKnownValues) {
    for (const auto& [z, p] :
         {std::pair(0.5, 0.61707507745197379), std::pair(1.96, 0.049995790296440872),
          std::pair(4.5, 6.7953462494601208e-6), std::pair(10.0, 1.5239706048321052e-23),
          std::pair(37.0, 1.1451142445049154e-299)}) {
        EXPECT_NEAR(normal_two_sided(z) / p, 1, 1e-12);
        EXPECT_EQ(normal_two_sided(-z), normal_two_sided(z));
    }
}

TEST(Distributions, ChiSquaredMatchesKnownValues) {
    for (const Known& k :
         {Known{0.1, 1, 0.75182963404584928}, Known{3.84145882069412, 1, 0.050000000000000177},
          Known{63, 63, 0.47630238333813013}, Known{120, 63, 2.010693881650069e-5},
          Known{1000, 63, 1.0740610347992447e-168}, Known{5, 200, 1},
          Known{200, 2, 3.720075976020836e-44}})
        EXPECT_NEAR(chi_squared_tail(k.x, k.dof) / k.p, 1, 1e-12) << k.x << ' ' << k.dof;
    EXPECT_EQ(chi_squared_tail(0, 3), 1);
}

TEST(Distributions, LeastOfManyIsExactAtBothEnds) {
    EXPECT_NEAR(least_of(1e-20, 1000), 1e-17, 1e-29);
    EXPECT_NEAR(least_of(0.5, 2), 0.75, 1e-15);
    EXPECT_EQ(least_of(1, 10), 1);
    EXPECT_EQ(least_of(0, 10), 0);
}

} // namespace
} // namespace tyndall::stats
