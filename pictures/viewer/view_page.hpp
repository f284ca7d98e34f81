// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace rovernet {

// The page as it is built into the library, see cmake/viewer.cmake: HTML with the marks <!--CSP-->
// and <!--DATA-->, and the Content-Security-Policy that allows its own script and style alone.
extern const std::string_view viewer_html;
extern const std::string_view viewer_policy;

/// Page of the viewer as one HTML file that contains a view file. The page needs no network.
/// @param other  view file of a second run, to be shown beside the first; empty: none
std::string page_with(std::string_view view_file, std::string_view other = {});

/// Page of the viewer for a server: it loads the view file from the server's path /run.rvw.
/// @param has_other  true: it loads a second view file, too, from /other.rvw
std::string served_page(bool has_other = false);
/// Page of the viewer for the server of a run that goes on: it gets the run's files by a WebSocket.
std::string live_page();

}  // namespace rovernet
