// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/listeners.hpp"
#include "live/carriers/input_rate.hpp"
#include "live/carriers/request.hpp"

#include <boost/asio.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace rovernet {

/// One program's connection to Doors.
struct DoorLink {
    using Clock = std::chrono::steady_clock;
    using Socket = boost::asio::generic::stream_protocol::socket;

    DoorLink(Socket taken, Doors::Connection number, const Doors::Streams* users)
        : socket(std::move(taken)), id(number), streams(users) {}

    /// Whether there is a whole line in the input.
    bool has_line() {
        const std::size_t end = input.find('\n', searched);
        searched = std::min(end, input.size());
        return end != std::string::npos;
    }

    /// Whether its bytes so far cannot begin a JSON object.
    bool begins_strangely() const {
        const std::size_t first = input.find_first_not_of(" \t\r");
        return first != input.npos && input[first] != '{';
    }
    RequestError strange_beginning() const {
        constexpr std::size_t shown = 16;  // [bytes]
        std::string found = input.substr(0, std::min(input.find_first_of("\r\n"), shown));
        const auto is_odd = [](char c) { return c < ' ' || c > '~'; };
        std::replace_if(found.begin(), found.end(), is_odd, '?');
        return {"bad_json", "",
                "found \"" + found + "\"; expected a JSON object in the first line"};
    }

    Socket socket;
    Doors::Connection id;
    const Doors::Streams* streams;  ///< null: it carries lines
    Clock::time_point since = Clock::now();
    InputRate rate = {};
    Clock::time_point closes_at = Clock::time_point::max();  ///< whatever is not out yet
    std::string input, sending, queued;
    std::size_t messages = 0;  ///< that are queued
    std::size_t searched = 0;  ///< of the input: there is no end of line
    bool has_spoken = false;   ///< a whole line; in a stream: a whole message
    bool is_reading = false, is_writing = false;
    bool is_answered = true;  ///< its last line
    bool has_ended = false;   ///< no more comes in
    bool is_closing = false;  ///< once all is out
};

}  // namespace rovernet
