// SPDX-License-Identifier: MIT
#include "models/propagation/ray_images.hpp"

#include <cmath>

namespace rovernet {

RayImages::RayImages(std::span<const Face> faces, Vec3 from, int order, double shortest, bool few)
    : faces_(faces), from_(from), few_(few && order > 0) {
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (faces[i].length >= shortest && faces[i].length > 0)
            mirrors_.push_back(static_cast<std::uint32_t>(i));
    for (int level = 1; level <= order - few_; ++level) {
        const std::size_t end = images_.size();
        if (level == 1) add_images_of(from, root);
        for (std::size_t i = parents_; i < end; ++i)
            add_images_of({images_[i].x, images_[i].y}, static_cast<std::uint32_t>(i));
        parents_ = end;
    }
    shared_ = images_.size();
}

/// Replaces the images of the highest order by those that a receiver sees.
void RayImages::add_seen_images(Vec3 receiver) {
    images_.resize(shared_);
    look_from(receiver);
    if (shared_ == 0) add_seen_images_of(from_, root);
    for (std::size_t i = parents_; i < shared_; ++i)
        add_seen_images_of({images_[i].x, images_[i].y}, static_cast<std::uint32_t>(i));
}

/// Finds the faces that may reflect to the receiver.
void RayImages::look_from(Vec3 receiver) {
    sights_.clear();
    bunches_.clear();
    for (const std::uint32_t number : mirrors_) {
        const Face& face = faces_[number];
        if (!(face.in_front(receiver) > 0)) continue;
        const auto line = [&](Vec3 unit) {
            return Line{unit.x, unit.y, -(unit.x * face.from.x + unit.y * face.from.y)};
        };
        const Line front = line(face.normal), along = line({-face.normal.y, face.normal.x, 0});
        const double off = front.at(receiver.x, receiver.y);
        sights_.push_back({front, along, face.length, off, along.at(receiver.x, receiver.y),
                           receiver - 2 * off * face.normal, number});
    }
    bunch(0, sights_.size());
}

/// Divides sights until each bunch has few, at the middle of its longer side.
void RayImages::bunch(std::size_t begin, std::size_t end) {
    if (begin == end) return;
    Vec3 low = sights_[begin].mirrored, high = low;
    for (std::size_t i = begin; i < end; ++i) {
        const Vec3 p = sights_[i].mirrored;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    constexpr std::size_t few = 8;
    if (end - begin <= few) {
        bunches_.push_back({begin, end, 0.5 * (low + high), distance(low, high) / 2});
        return;
    }
    const bool wide = high.x - low.x > high.y - low.y;
    const auto at = [&](std::size_t i) { return sights_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [&](const Sight& p, const Sight& q) {
        return wide ? p.mirrored.x < q.mirrored.x : p.mirrored.y < q.mirrored.y;
    });
    bunch(begin, middle);
    bunch(middle, end);
}

/// Adds the images of the highest order, for faces that reflect to the receiver.
void RayImages::add_seen_images_of(Vec3 at, std::uint32_t parent) {
    for (const Bunch& bunch : bunches_) {
        // A ray that the face reflects to the receiver runs straight to the mirrored receiver.
        const auto misses = [&](const Line& line) {
            return line.at(bunch.centre.x, bunch.centre.y) < -(bunch.radius + 2 * slack);
        };
        if (parent != root &&
            std::any_of(images_[parent].beam.begin(), images_[parent].beam.end(), misses))
            continue;
        add_seen_images_of(at, parent,
                           std::span(sights_).subspan(bunch.begin, bunch.end - bunch.begin));
    }
}

void RayImages::add_seen_images_of(Vec3 at, std::uint32_t parent, std::span<const Sight> sights) {
    for (const Sight& sight : sights) {
        const double front = sight.front.at(at.x, at.y);
        if (!(front > slack)) continue;
        // The point of reflection divides the path along the face in the ratio of the distances in
        // front of it.
        const double whole = front + sight.receiver_front;
        const double point =
            sight.along.at(at.x, at.y) * sight.receiver_front + sight.receiver_along * front;
        if (point < -slack * whole || point > (sight.length + slack) * whole) continue;
        add_image(at, parent, sight.face);
    }
}

void RayImages::add_images_of(Vec3 at, std::uint32_t parent) {
    for (const std::uint32_t face : mirrors_)
        if (faces_[face].in_front(at) > slack) add_image(at, parent, face);
}

/// Adds the image in a face, if the beam hits the face.
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
    // The wall and the image are on the left of the face; so the beam is on the left of its start.
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
