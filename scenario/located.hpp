// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace rovernet {

/// Runs `make`; a caller's-fault exception in it is the input's fault at `where`.
auto located(const Location& where, auto&& make) {
    try {
        return make();
    } catch (const InputError&) {
        throw;
    } catch (const std::invalid_argument& error) {
        throw InputError(where, error.what());
    }
}

/// Runs `make`; if it finds no fault at a line of a file but with the file as a whole (missing,
/// say), that is the fault of `where`, which names the file as its `key`.
auto located_file(const Location& where, std::string_view key, auto&& make) {
    try {
        return make();
    } catch (const InputError& error) {
        if (error.where().line > 0 || where.line == 0) throw;
        throw InputError(where, fmt::format("{}: {}", key, error.what()));
    }
}

}  // namespace rovernet
