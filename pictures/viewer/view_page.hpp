// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace rovernet {

// Page as built into the library (cmake/viewer.cmake): HTML with the placeholders <!--CSP--> and
// <!--DATA-->; and its Content-Security-Policy, which allows only the page's own script and style.
extern const std::string_view viewer_html;
extern const std::string_view viewer_policy;

/// Page of the viewer as one HTML file that contains a view file, and needs no server.
/// @param other  view file of a second run, to be shown beside the first; empty: none
std::string page_with(std::string_view view_file, std::string_view other = {});

/// Page of the viewer for a server: it loads the view file from the server's path /run.rvw.
/// @param has_other  true: the page also loads a second view file, from /other.rvw
std::string served_page(bool has_other = false);
/// Content-Security-Policy of the pages for a server, as in their <meta>.
std::string served_policy();
/// Page of the viewer for a live run: the page gets the run's view files by a WebSocket.
std::string live_page();

}  // namespace rovernet
