// SPDX-License-Identifier: MIT
#include "cli/diagnostics.hpp"

#include "cli/commands.hpp"
#include "experiment/run.hpp"
#include "sim/error.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

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

/// Says what went wrong; a mistake in an input begins with its place, anything else with our name.
int fail(ExitCode code, const std::string& message) {
    error(code == bad_input ? message : "rovernet: " + message);
    return code;
}

}  // namespace

void notice(std::string_view message) { logger().info("{}", message); }
void error(std::string_view message) { logger().error("{}", message); }

int guarded(const std::function<void()>& command) {
    try {
        command();
        return std::fflush(stdout) == 0 ? ok : failed;
    } catch (const InputError& error) {
        return fail(error.where().is_option ? usage : bad_input, error.what());
    } catch (const CommandEnd& end) {
        std::fflush(stdout);
        return fail(end.code(), end.what());
    } catch (const Interrupted&) {
        return fail(interrupted, "interrupted; no results were written");
    } catch (const std::invalid_argument& error) {
        return fail(usage, error.what());
    } catch (const std::bad_alloc&) {
        return fail(failed, "out of memory");
    } catch (const std::exception& error) {
        return fail(failed, error.what());
    }
}

}  // namespace rovernet::cli
