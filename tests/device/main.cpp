#include "device/device_test.h"

#include <cstdio>

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const int status = RUN_ALL_TESTS();
    tyndall::device_test::close_context();
    if (testing::UnitTest::GetInstance()->test_to_run_count() > 0) return status;
    std::fprintf(stderr, "no test has such a name\n");
    return 1;
}
