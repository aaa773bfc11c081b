#include "cli/options.h"
#include "core/error.h"

#include <cstdio>
#include <exception>
#include <new>

int main(int argc, char** argv) {
    using tyndall::ExitStatus;
    try {
        return tyndall::cli::run(argc, argv);
    } catch (const tyndall::SceneError& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return static_cast<int>(e.status());
    } catch (const tyndall::Error& e) {
        std::fprintf(stderr, "tyndall: error: %s\n", e.what());
        return static_cast<int>(e.status());
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "tyndall: error: out of memory\n");
        return static_cast<int>(ExitStatus::failed);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "tyndall: error: %s\n", e.what());
        return static_cast<int>(ExitStatus::failed);
    }
}
