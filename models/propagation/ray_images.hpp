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

/// Mirror images of a sender in the faces of a scene, in plan, for finding reflected paths to a
/// receiver.
///
/// Each image has a beam: the sector from the image through the face that made it. An image of
/// order n is made by mirroring an image of order n - 1 in a face that lies within its beam. F
/// faces have up to F (F - 1)^(n - 1) images; the beams leave far fewer. Walls between the faces
/// are ignored here, because radio waves pass through walls.
class RayImages {
  public:
    /// Empty set: no faces, no images.
    RayImages() = default;
    /// @param faces     faces of the scene; must outlive the images
    /// @param order     largest number of reflections, >= 0
    /// @param shortest  length [m] below which faces do not reflect
    /// @param few       true: the images of the highest order, which are most of the images, are
    ///                  computed for each receiver separately: only images that this receiver
    ///                  sees. This is faster for few receivers, and slower for many.
    RayImages(std::span<const Face> faces, Vec3 from, int order, double shortest, bool few = false);

    /// Calls visit(chain) for each image whose beam contains the point p, with a tolerance of 1e-7
    /// m; chain: the image's faces, last reflection first.
    template <class Visit>
    void seen_from(Vec3 p, Visit visit) {
        if (few_) add_seen_images(p);
        for (const Image& image : images_) {
            const auto& [front, left, right] = image.beam;
            // The minimum needs one branch; three branches would often be mispredicted.
            const double least =
                std::min(front.at(p.x, p.y), std::min(left.at(p.x, p.y), right.at(p.x, p.y)));
            if (least >= -slack) visit(chain_of(image));
        }
    }

  private:
    static constexpr double slack = 1e-7;  // tolerance of a beam's sides [m]
    static constexpr std::uint32_t root = static_cast<std::uint32_t>(-1);  // parent: sender
    /// Line in plan: the signed distance of the point (x, y) from the line is a x + b y + c [m].
    struct Line {
        double a, b, c;
        double at(double x, double y) const { return a * x + b * y + c; }
    };
    struct Image {
        std::array<Line, 3> beam;  // line of the face, and of the beam's two sides
        double x, y;               // position of the image [m]
        std::uint32_t face, parent;
    };
    /// Face whose front the receiver sees, with the receiver's mirror image in the face.
    struct Sight {
        Line front, along;  // distance [m] in front of the face; position along it from its start
        double length;      // length of the face [m]
        double receiver_front, receiver_along;  // `front` and `along` of the receiver [m]
        Vec3 mirrored;                          // mirror image of the receiver [m]
        std::uint32_t face;
    };
    /// Group of faces whose mirror images of the receiver lie in one circle.
    struct Bunch {
        std::size_t begin, end;  // range of indices into sights_
        Vec3 centre;
        double radius;  // radius of the circle [m]
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
    std::vector<Sight> sights_;   // faces seen by the last receiver
    std::vector<Bunch> bunches_;  // groups of sights_
    std::vector<Image> images_;
    std::size_t shared_ = 0;   // number of images common to all receivers
    std::size_t parents_ = 0;  // index of the first image that has images of the highest order
    std::vector<std::uint32_t> chain_;
};

}  // namespace rovernet
