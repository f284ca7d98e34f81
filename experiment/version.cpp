// SPDX-License-Identifier: MIT
#include "experiment/version.hpp"

#include "version_build.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <ctime>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace rovernet {

std::string_view version() { return build::version; }

namespace {

std::string code_version_now() {
    std::string text = fmt::format("{} ({:.12}", build::version, build::commit);
    if (build::dirty || std::string_view(build::commit) == "unknown") {
        std::ifstream file("/proc/self/exe", std::ios::binary);
        std::stringstream bytes;
        bytes << file.rdbuf();
        const std::string program = bytes.str();
        text += fmt::format(" changed {:016x}", XXH64(program.data(), program.size(), 0));
    }
    return text + ")";
}

}  // namespace

const std::string& code_version() {
    static const std::string version = code_version_now();
    return version;
}

Table build_provenance() {
    Table table;
    table.set("version", build::version);
    table.set("commit", build::commit);
    table.set("dirty", build::dirty);
    table.set("compiler", build::compiler);
    table.set("build_type", build::type);
    table.set("flags", build::flags);
    return table;
}

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                       utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string host_name() {
    char name[256] = {};
    return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

}  // namespace rovernet
