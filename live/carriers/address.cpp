// SPDX-License-Identifier: MIT
#include "live/carriers/address.hpp"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <stdexcept>

namespace rovernet {
namespace {

[[noreturn]] void fail(const std::string& text, const std::string& why) {
    throw std::invalid_argument(fmt::format(
        "{}: {}; expected an address that only this machine can reach, such as 127.0.0.1:7007",
        text, why));
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

std::string without_brackets(const std::string& host) {
    return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

bool is_number(const std::string& host) {
    in6_addr number{};  // one of IPv4 fits into it, too
    return inet_pton(AF_INET, host.c_str(), &number) == 1 ||
           inet_pton(AF_INET6, host.c_str(), &number) == 1;
}

}  // namespace

std::string Address::text() const {
    const bool is_v6 = host.find(':') != std::string::npos;
    return is_v6 ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

bool Address::is_loopback() const {
    in_addr v4{};
    if (inet_pton(AF_INET, host.c_str(), &v4) == 1) {
        return (ntohl(v4.s_addr) >> 24U) == IN_LOOPBACKNET;
    }
    in6_addr v6{};
    return inet_pton(AF_INET6, host.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6) != 0;
}

Address read_loopback(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) fail(text, "found no port");
    std::string host = without_brackets(text.substr(0, colon));
    if (host == "localhost") host = "127.0.0.1";
    const Address address{host, read_port(text, text.substr(colon + 1))};
    if (!is_number(host)) fail(text, fmt::format("found the host \"{}\"", host));
    if (!address.is_loopback()) {
        fail(text, "other machines can connect only with the option --listen");
    }
    return address;
}

std::string read_host(const std::string& text) {
    std::string host = without_brackets(text);
    if (is_number(host)) return host;
    throw std::invalid_argument(
        text + ": expected an IP address of this machine, such as 192.168.1.5, or 0.0.0.0 for all");
}

}  // namespace rovernet
