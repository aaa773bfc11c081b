#include "cli/interrupt.h"
#include "cli/options.h"
#include "core/error.h"
#include "gpu/context.h"
#include "selftest/selftest.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tyndall::cli {
namespace {

using nlohmann::json;
using selftest::Row;

const char* verdict(const Row& row) {
    return row.passed() ? "passed" : "FAILED";
}

void print_row(const Row& row) {
    std::printf("%-36s %13.7g %13.7g %+10.1e %9.1e  %s\n", row.name.c_str(), row.expected, row.got,
                row.error(), row.allowed, verdict(row));
    std::fflush(stdout);
}

json to_json(const Row& row) {
    return {{"case", row.name},     {"expected", row.expected}, {"got", row.got},
            {"error", row.error()}, {"allowed", row.allowed},   {"passed", row.passed()}};
}

} // namespace

int run_selftest(const SelftestOptions& options) {
    watch_interrupts();
    const gpu::Context context(
        {.device = options.device.device, .validate = options.device.validate});
    const std::string device = fmt::format("{} ({})", context.info().name, context.info().driver);
    if (!options.json)
        std::printf("%s\n%-36s %13s %13s %10s %9s  verdict\n", device.c_str(), "case", "expected",
                    "got", "error", "allowed");
    const std::vector<Row> rows = selftest::run(context, options.corrupt, [&](const Row& row) {
        if (!options.json) print_row(row);
        return !was_interrupted();
    });
    if (was_interrupted()) throw Error(ExitStatus::interrupted, "interrupted");
    const auto failed =
        std::count_if(rows.begin(), rows.end(), [](const Row& row) { return !row.passed(); });
    if (options.json) {
        json list = json::array();
        for (const Row& row : rows)
            list.push_back(to_json(row));
        std::printf(
            "%s\n",
            json{{"device", device}, {"passed", failed == 0}, {"rows", list}}.dump(2).c_str());
    } else {
        std::printf("%zu of %zu passed\n", rows.size() - static_cast<std::size_t>(failed),
                    rows.size());
    }
    if (context.validation_messages() > 0)
        throw Error(ExitStatus::failed, "the validation layer had messages");
    return static_cast<int>(failed == 0 ? ExitStatus::done : ExitStatus::failed);
}

} // namespace tyndall::cli
