// SPDX-License-Identifier: MIT
#include "live/loopback.hpp"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <stdexcept>

namespace rovernet {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& why) {
    throw std::invalid_argument(fmt::format(
        "{}: {}; expected an address of this machine alone, such as 127.0.0.1:7007", text, why));
}

std::uint16_t read_port(const std::string& text, const std::string& port) {
    constexpr unsigned long last_port = 65'535;
    const bool is_number = !port.empty() && port.size() <= 5 &&
                           port.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number || std::stoul(port) > last_port) {
        fail(text, fmt::format("found the port \"{}\"", port));
    }
    return static_cast<std::uint16_t>(std::stoul(port));
}

}  // namespace

std::string Loopback::text() const {
    const bool is_v6 = host.find(':') != std::string::npos;
    return is_v6 ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

Loopback read_loopback(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) fail(text, "found no port");
    std::string host = text.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
    if (host == "localhost") host = "127.0.0.1";
    const Loopback address{host, read_port(text, text.substr(colon + 1))};
    in_addr v4{};
    in6_addr v6{};
    const bool is_v4 = inet_pton(AF_INET, host.c_str(), &v4) == 1;
    if (!is_v4 && inet_pton(AF_INET6, host.c_str(), &v6) != 1) {
        fail(text, fmt::format("found the host \"{}\"", host));
    }
    const bool is_own =
        is_v4 ? (ntohl(v4.s_addr) >> 24U) == IN_LOOPBACKNET : IN6_IS_ADDR_LOOPBACK(&v6) != 0;
    if (!is_own) fail(text, "this door has no password");
    return address;
}

}  // namespace rovernet
