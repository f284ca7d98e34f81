// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <stdexcept>

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

}  // namespace rovernet
