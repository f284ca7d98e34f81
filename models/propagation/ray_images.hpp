// SPDX-License-Identifier: MIT
#pragma once

#include "scene/faces.hpp"
#include "sim/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rovernet {

/// Mirror images of a sender in the faces of a scene, in plan: what a receiver may see of it by
/// way of reflections.
///
/// An image of order n is that of an image of order n - 1, in a face that lies before it and in
/// the beam in which it is seen: the sector from the image through its own face. There are up to
/// F (F - 1)^(n - 1) of them for F faces; the beams leave far fewer. Walls that stand between do
/// not count here: radio passes through walls.
class RayImages {
  public:
    /// Empty: no faces, no images.
    RayImages() = default;
    /// @param faces  outlives the images
    /// @param order  most reflections, >= 0
    /// @param shortest  faces shorter than this [m] reflect nothing
    /// @param few  images of the highest order are made anew for each point that is asked for, only
    ///             those that it sees. They are most of the images: this takes less time for a few
    ///             points, and more for many.
    RayImages(std::span<const Face> faces, Vec3 from, int order, double shortest, bool few = false);

    /// Calls visit(chain) for each image in whose beam a point lies, beams being a tenth of a
    /// micrometre wider than they are; chain: the image's faces, the last reflection first.
    template <class Visit>
    void seen_from(Vec3 p, Visit visit) {
        if (few_) add_seen_images(p);
        for (const Image& image : images_) {
            const auto& [front, left, right] = image.beam;
            // All three at once: a branch for each would be mispredicted.
            const double least =
                std::min(front.at(p.x, p.y), std::min(left.at(p.x, p.y), right.at(p.x, p.y)));
            if (least >= -slack) visit(chain_of(image));
        }
    }

  private:
    static constexpr double slack = 1e-7;                                  // [m]
    static constexpr std::uint32_t root = static_cast<std::uint32_t>(-1);  // the sender
    /// Distance from a line [m]: a x + b y + c.
    struct Line {
        double a, b, c;
        double at(double x, double y) const { return a * x + b * y + c; }
    };
    struct Image {
        std::array<Line, 3> beam;  // in front of the face, and between two sides
        double x, y;               // [m]
        std::uint32_t face, parent;
    };
    /// Face with the receiver in front of it.
    struct Sight {
        Line front, along;  // distance [m] in front of the face, and along it from its beginning
        double length;      // of the face [m]
        double receiver_front, receiver_along;  // [m]
        Vec3 mirrored;                          // the receiver's image in the face
        std::uint32_t face;
    };
    /// Sights whose mirrored receivers lie in one circle.
    struct Bunch {
        std::size_t begin, end;  // of sights_
        Vec3 centre;
        double radius;  // [m]
    };
    void add_images_of(Vec3 at, std::uint32_t parent);
    void add_seen_images(Vec3 receiver);
    void add_seen_images_of(Vec3 at, std::uint32_t parent);
    void add_seen_images_of(Vec3 at, std::uint32_t parent, std::span<const Sight> sights);
    void look_from(Vec3 receiver);
    void bunch(std::size_t begin, std::size_t end);
    void add_image(Vec3 at, std::uint32_t parent, std::uint32_t face);
    std::span<const std::uint32_t> chain_of(const Image& image);

    std::span<const Face> faces_;
    std::vector<std::uint32_t> mirrors_;  // faces that reflect
    Vec3 from_{};
    bool few_ = false;
    std::vector<Sight> sights_;   // of the last receiver
    std::vector<Bunch> bunches_;  // of them
    std::vector<Image> images_;
    std::size_t shared_ = 0;   // images of all receivers
    std::size_t parents_ = 0;  // the first of those with images of the highest order
    std::vector<std::uint32_t> chain_;
};

}  // namespace rovernet
