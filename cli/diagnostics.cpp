// SPDX-License-Identifier: MIT
#include "cli/diagnostics.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace rovernet::cli {
namespace {

spdlog::logger& logger() {
    static const auto log = [] {
        auto made = spdlog::stderr_logger_mt("rovernet");
        made->set_pattern("%v");
        return made;
    }();
    return *log;
}

}  // namespace

void notice(std::string_view message) { logger().info("{}", message); }
void error(std::string_view message) { logger().error("{}", message); }

}  // namespace rovernet::cli
