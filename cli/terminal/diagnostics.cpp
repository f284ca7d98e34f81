// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"

#include "cli/terminal/commands.hpp"
#include "experiment/run.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>

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

/// Standard output did not take what was written.
int output_failed(int error) {
    if (error == EPIPE) {
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);
    }
    return fail(failed, fmt::format("the output cannot be written: {}", std::strerror(error)));
}

}  // namespace

void set_verbosity(Verbosity verbosity) {
    switch (verbosity) {
        case Verbosity::errors: return logger().set_level(spdlog::level::err);
        case Verbosity::notices: return logger().set_level(spdlog::level::info);
        case Verbosity::everything: return logger().set_level(spdlog::level::debug);
    }
}

bool shows_progress() {
    return isatty(STDERR_FILENO) != 0 && logger().should_log(spdlog::level::info);
}

bool tells_details() { return logger().should_log(spdlog::level::debug); }

void detail(std::string_view message) { logger().debug("{}", message); }
void notice(std::string_view message) { logger().info("{}", message); }
void error(std::string_view message) { logger().error("{}", message); }

void to_terminal(std::string_view text) {
    (void)!std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

int end_output() {
    errno = EIO;  // of an earlier write, if the last succeeds
    const bool flushed = std::fflush(stdout) == 0;
    return flushed && std::ferror(stdout) == 0 ? ok : output_failed(errno);
}

int guarded(const std::function<void()>& command) {
    try {
        command();
        return end_output();
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
    } catch (const std::system_error& error) {
        return std::ferror(stdout) != 0 ? output_failed(error.code().value())
                                        : fail(failed, error.what());
    } catch (const std::exception& error) {
        return fail(failed, error.what());
    }
}

}  // namespace rovernet::cli
