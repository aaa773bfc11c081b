#include "support/gpu_context.h"

int main(int argc, char** argv) {
    return tyndall::support::run_gpu_tests(argc, argv);
}
