// SPDX-License-Identifier: MIT
#pragma once
#include <sys/resource.h>

/// CPU time and memory that this process has used so far.
struct Usage {
    double cpu_s;   ///< user and system time [s]
    double rss_mb;  ///< largest resident set [MiB]

    static Usage now() {
        rusage used{};
        getrusage(RUSAGE_SELF, &used);
        const auto seconds = [](const timeval& t) {
            return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
        };
        return {seconds(used.ru_utime) + seconds(used.ru_stime),
                static_cast<double>(used.ru_maxrss) / 1024.0};
    }
};
