// SPDX-License-Identifier: MIT
#include "live/lockstep/listeners.hpp"

#include "live/lockstep/answer.hpp"

#include <memory>
#include <utility>

namespace rovernet {

FrontListeners lockstep_listeners(const ControllerAccess& access, Lockstep::Settings settings) {
    FrontListeners listeners{.programs = access.programs, .unix_path = access.unix_path};
    if (access.listen) listeners.entries.push_back({*access.listen});
    if (access.web) listeners.entries.push_back({.at = *access.web, .is_web = true});
    const bool others_may_come = !listeners.entries.empty() || access.unix_path;
    if (!others_may_come) settings.programs = access.programs.size();
    listeners.make = [settings = std::move(settings)](Front::Carrier carrier) {
        return std::make_unique<Lockstep>(settings, std::move(carrier));
    };
    listeners.line_error = [](const RequestError& why) { return error_line(why, {}); };
    listeners.has_rate = false;  // each line is answered first
    return listeners;
}

}  // namespace rovernet
