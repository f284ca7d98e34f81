// SPDX-License-Identifier: MIT
#pragma once

#include "sim/complex_math.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rovernet {

/// Corner near a path around a row of bodies; the path is a taut string, unrolled to a straight
/// line.
struct RowCorner {
    double at;     ///< position along the line [m], from its start
    double below;  ///< distance [m] below the shortest path around all bodies (a taut string); 0
                   ///< if the string touches the corner
    double bend;   ///< angle of the string's turn at the corner [rad], >= 0; 0 without contact
    std::size_t body;  ///< number of the corner's body; the corners of a body are consecutive
};

/// Field at the end of a path past a row of bodies, relative to free space.
///
/// The fields at consecutive edges depend on each other like successive values of a random walk, so
/// the field past all edges is close to that of a tree of pairs,
///
///   product of F_i over all corners, times product of F_ij / (F_i F_j) over the tree,
///
/// with the field F_i past corner i alone, and the field F_ij past a pair: pair_field(). The tree
/// contains the pairs within each body, and the pairs between bodies that maximise the field; a
/// corner far below the line is in no pair. The product is exact for two edges, and in deep shadow
/// for any number of edges. Behind n evenly spaced screens that touch the line, where the field is
/// 1 / (n + 1), its error is 0.3 dB for three and 1.7 dB for six. The field is continuous when
/// corners move into or out of the path.
///
/// Sources: C. K. Chow, C. N. Liu, Approximating discrete probability distributions with dependence
/// trees, IEEE Trans. Inf. Theory 14(3), 1968; S. W. Lee, Path integrals for solving some
/// electromagnetic edge diffraction problems, J. Math. Phys. 19(6), 1978, for 1 / (n + 1).
class EdgeRow {
  public:
    /// @param corners  corners in the order of the path
    /// @param length   length of the path [m]
    EdgeRow(std::vector<RowCorner> corners, double length, double wavelength);
    /// Field past the row [-], with its phase relative to that of the path.
    /// @param left_out  flag for each body: true if the body is ignored
    math::Complex field_without(std::span<const char> left_out) const;

  private:
    struct Link {
        std::size_t i, k;
        math::Complex factor;  // F_ij / (F_i F_j)
        double weight;         // |factor|; infinite for a pair of one body
    };
    Link link(std::size_t i, std::size_t k) const;

    std::vector<RowCorner> corners_;
    double length_, wavelength_;
    std::vector<math::Complex> alone_;
    std::vector<Link> links_;  // links in descending order of weight
};

}  // namespace rovernet
