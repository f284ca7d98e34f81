// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet::cli {

/// Opens an address, or a file, in the user's browser: starts xdg-open and does not wait for the
/// browser. Without xdg-open a notice says so.
void open_in_browser(const std::string& address);

}  // namespace rovernet::cli
