// SPDX-License-Identifier: MIT
#include "models/propagation/ray_images.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {

RayImages::RayImages(std::span<const Face> faces, Vec3 from, int order, double shortest)
    : faces_(faces) {
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (faces[i].length >= shortest && faces[i].length > 0)
            mirrors_.push_back(static_cast<std::uint32_t>(i));
    if (order == 0) return;
    add_images_of(from, root);
    std::size_t begin = 0;
    for (int level = 2; level <= order; ++level) {
        const std::size_t end = images_.size();
        for (std::size_t i = begin; i < end; ++i)
            add_images_of({images_[i].x, images_[i].y}, static_cast<std::uint32_t>(i));
        begin = end;
    }
}

void RayImages::add_images_of(Vec3 at, std::uint32_t parent) {
    for (const std::uint32_t face : mirrors_)
        if (faces_[face].in_front(at) > slack) add_image(at, parent, face);
}

/// Adds the image in a face, if the beam falls on the face.
void RayImages::add_image(Vec3 at, std::uint32_t parent, std::uint32_t number) {
    const Face& face = faces_[number];
    const Vec3 along = face.to - face.from;
    double first = 0, last = 1;  // the lit part of the face
    if (parent != root) {
        for (const Line& line : images_[parent].beam) {
            const double d0 = line.at(face.from.x, face.from.y) + slack;
            const double d1 = line.at(face.to.x, face.to.y) + slack;
            if (d0 < 0 && d1 < 0) return;
            if (d0 < 0) first = std::max(first, d0 / (d0 - d1));
            if (d1 < 0) last = std::min(last, d0 / (d0 - d1));
        }
        if (first > last) return;
    }
    const Vec3 image = at - 2 * face.in_front(at) * face.normal;
    // The wall and the image are on the left of the face: the beam is on the left of its beginning.
    const auto side = [&](Vec3 through, double sign) {
        const Vec3 d = through - image;
        const double scale = sign / std::sqrt(d.x * d.x + d.y * d.y);
        return Line{-d.y * scale, d.x * scale, (d.y * image.x - d.x * image.y) * scale};
    };
    const Line front{face.normal.x, face.normal.y,
                     -(face.normal.x * face.from.x + face.normal.y * face.from.y)};
    images_.push_back(
        {{front, side(face.from + first * along, 1), side(face.from + last * along, -1)},
         image.x,
         image.y,
         number,
         parent});
}

std::span<const std::uint32_t> RayImages::chain_of(const Image& image) {
    chain_.clear();
    const Image* at = &image;
    for (;;) {
        chain_.push_back(at->face);
        if (at->parent == root) return chain_;
        at = &images_[at->parent];
    }
}

}  // namespace rovernet
