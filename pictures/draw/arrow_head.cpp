// SPDX-License-Identifier: MIT
#include "pictures/draw/arrow_head.hpp"

#include <cmath>

namespace rovernet {

void append_arrow_head(SvgPath& heads, PicturePoint from, PicturePoint to, double back,
                       double width) {
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    const double size = 6 + 1.5 * width;
    if (length < back + size) return;
    const double ux = dx / length, uy = dy / length;
    const PicturePoint tip{to.x - back * ux, to.y - back * uy};
    const PicturePoint base{tip.x - size * ux, tip.y - size * uy};
    const double half = 0.45 * size;
    heads.move(tip.x, tip.y).line(base.x - half * uy, base.y + half * ux);
    heads.line(base.x + half * uy, base.y - half * ux).close();
}

}  // namespace rovernet
