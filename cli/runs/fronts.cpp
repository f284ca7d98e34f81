// SPDX-License-Identifier: MIT
#include "cli/runs/fronts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet::cli {

std::vector<Option> FrontArguments::add_to(Command command) {
    std::vector<Option> options;
    for (std::size_t i = 0; i < addresses.size(); ++i) {
        const FrontOption& front = *front_options[i];
        const std::string_view port = front.usual.substr(front.usual.rfind(':') + 1);
        const std::string help = fmt::format(
            "serve {}, at 127.0.0.1:PORT; port 0 selects a free port (default port: {})",
            front.serves, port);
        options.push_back(
            command.add_option(front.name, addresses[i], help.c_str()).usually(front.usual.data()));
    }
    return options;
}

bool FrontArguments::any() const {
    return std::any_of(addresses.begin(), addresses.end(),
                       [](const auto& address) { return address.has_value(); });
}

void FrontArguments::append_to(std::vector<FrontListeners>& fronts, const Reach& reach) const {
    for (std::size_t i = 0; i < addresses.size(); ++i) {
        if (!addresses[i]) continue;
        fronts.push_back(front_options[i]->listeners(reach.with_token(*addresses[i])));
    }
}

}  // namespace rovernet::cli
