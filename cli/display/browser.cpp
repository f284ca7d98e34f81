// SPDX-License-Identifier: MIT
#include "cli/display/browser.hpp"

#include "cli/terminal/diagnostics.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rovernet::cli {

void open_in_browser(const std::string& address) {
    // The shell leaves the browser in a process group of its own, which Ctrl-C does not reach.
    std::string shell = "sh", option = "-c", name = "rovernet", argument = address,
                script =
                    "command -v xdg-open > /dev/null || exit 127; "
                    "xdg-open \"$1\" < /dev/null > /dev/null 2>&1 &";
    char* arguments[] = {shell.data(), option.data(),   script.data(),
                         name.data(),  argument.data(), nullptr};
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    pid_t child = -1;
    int status = -1;
    const bool is_started =
        posix_spawn(&child, "/bin/sh", nullptr, &attributes, arguments, environ) == 0;
    posix_spawnattr_destroy(&attributes);
    if (is_started && waitpid(child, &status, 0) == child && status == 0) return;
    notice("--open: the program xdg-open is not installed; open " + address + " in a browser");
}

}  // namespace rovernet::cli
