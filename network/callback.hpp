// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

namespace rovernet {

/// Shared, so that a callback keeps its state and outlives its being replaced while it runs.
template <class... Arguments>
using Callback = std::shared_ptr<std::function<void(Arguments...)>>;

}  // namespace rovernet
