// SPDX-License-Identifier: MIT
#include "cli/display/picture_output.hpp"

#include "cli/terminal/stop.hpp"
#include "pictures/draw/picture_file.hpp"
#include "sim/error.hpp"

namespace rovernet::cli {

void check_picture_name(const std::string& out) {
    if (is_picture_name(out)) return;
    throw InputError(Location{"--output " + out, 0, 0, true},
                     "expected a name that ends in .svg, .png or .pdf; for example office.svg");
}

void write_picture(const std::string& out, const std::string& svg) {
    write_whole({{out, picture_bytes(svg, out)}});
}

}  // namespace rovernet::cli
