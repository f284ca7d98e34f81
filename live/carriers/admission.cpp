// SPDX-License-Identifier: MIT
#include "live/carriers/admission.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sys/random.h>
#include <utility>

namespace rovernet {
namespace {

/// The value of `token` in the query of a target; empty if there is none.
std::string_view token_in(std::string_view target) {
    constexpr std::string_view key = "token=";
    std::size_t at = target.find('?');
    while (at != target.npos) {
        target.remove_prefix(at + 1);
        if (target.starts_with(key))
            return target.substr(key.size(), target.find('&') - key.size());
        at = target.find('&');
    }
    return {};
}

/// Compares texts in a time independent of the place of the first difference, against timing
/// attacks.
bool are_equal(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    }
    return difference == 0;
}

}  // namespace

Admission::Admission(Address address, std::string token)
    : address_(std::move(address)), token_(std::move(token)) {}

std::string Admission::refusal(const WebRequest& request) const {
    const bool knows = !token_.empty() && are_equal(token_in(request.target), token_);
    if (!address_.is_loopback()) {
        return knows
                   ? ""
                   : "expected ?token= at the end of the address, with the token that this server "
                     "printed at its start";
    }
    const std::array<std::string, 4> names = {
        address_.text(), fmt::format("127.0.0.1:{}", address_.port),
        fmt::format("localhost:{}", address_.port), fmt::format("[::1]:{}", address_.port)};
    if (std::find(names.begin(), names.end(), request.host) == names.end()) {
        return fmt::format("Host: found \"{}\"; expected {}", request.host, names[0]);
    }
    if (!request.origin || *request.origin == fmt::format("http://{}", request.host)) return {};
    if (knows) return {};
    return fmt::format(
        "Origin: found \"{}\"; a page of a different server needs the token that this server "
        "printed at its start",
        *request.origin);
}

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw RunError("cannot make a token: the operating system provides no random bytes");
    }
    return fmt::format("{:02x}", fmt::join(bytes, ""));
}

}  // namespace rovernet
