// SPDX-License-Identifier: MIT
#include "models/propagation/edges/diffraction.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

namespace diffraction_test {
using namespace rovernet;
using math::Complex;
using std::numbers::pi;
using test::near;
using test::Vectors;

namespace {

constexpr double degree = pi / 180;
constexpr double field_rounding = 1e-11;  // [-], the vectors carry 15 digits

Complex wave(double phase) { return std::polar(1.0, phase); }

/// Total field at r [m] from a wedge's edge, of a plane wave whose field at the edge is 1.
Complex total_field(const WedgePath& path, double k, double r, const WedgeFaces& faces, LitBy lit) {
    const double phi = path.phi.value, phi_i = path.phi_incident.value;
    Complex sum = wedge_coefficient(path, k, Meters{r}, faces, lit) * wave(-k * r) / std::sqrt(r);
    sum += (lit.direct ? Complex{1} : faces.through) * wave(k * r * std::cos(phi - phi_i));
    if (lit.face_0) sum += faces.face_0 * wave(k * r * std::cos(phi + phi_i));
    if (lit.face_n) sum += faces.face_n * wave(k * r * std::cos(2 * path.n * pi - phi - phi_i));
    return sum;
}
Complex total_field(const WedgePath& path, double k, double r, const WedgeFaces& faces) {
    return total_field(path, k, r, faces, lit_by(path));
}

double decibels(Complex field) { return 20 * std::log10(std::abs(field)); }

struct Row {
    WedgePath path;
    double k;
    Complex soft, hard;
    double soft_error, hard_error;  // of the uniform theory [dB]
    bool screen;
};
Row row_of(const Vectors& v, std::size_t i) {
    const bool screen = v.text(i, "wedge") == "half-plane";
    return {{.n = screen ? 2 : 1.5,
             .phi = {v.number(i, "phi_deg") * degree},
             .phi_incident = {v.number(i, "phi_inc_deg") * degree}},
            v.number(i, "k_rho"),
            {v.number(i, "Es_re"), v.number(i, "Es_im")},
            {v.number(i, "Eh_re"), v.number(i, "Eh_im")},
            v.number(i, "UTD_err_s_dB"),
            v.number(i, "UTD_err_h_dB"),
            screen};
}

template <class Check>
std::size_t for_each_row(bool screen, Check check) {
    const Vectors vectors("utd_vs_exact.csv");
    std::size_t rows = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const Row row = row_of(vectors, i);
        if (row.screen != screen) continue;
        CAPTURE(i);
        check(row);
        ++rows;
    }
    return rows;
}

}  // namespace

TEST_CASE("knife edge: the loss equals that of the Fresnel integrals (table knife_edge)") {
    const Vectors vectors("knife_edge.csv");
    REQUIRE(vectors.size() == 28);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double nu = vectors.number(i, "nu");
        CAPTURE(nu);
        CHECK(near(knife_edge_loss_db(nu), vectors.number(i, "J_exact_dB"), 1e-9));
        CHECK(near(knife_edge_loss_p526_db(nu), vectors.number(i, "J_P526_approx_dB"), 1e-9));
    }
}

TEST_CASE(
    "knife edge: in deep shadow, at nu = 1e8 and beyond, the loss is right within 1e-9 dB (S18)") {
    for (const double nu : {1e4, 1e6, 1e8, 1e12, 1e100}) {
        CAPTURE(nu);
        CHECK(near(knife_edge_loss_db(nu), 20 * std::log10(pi * std::sqrt(2.0) * nu), 1e-9));
    }
    CHECK(std::isinf(knife_edge_loss_db(std::numeric_limits<double>::infinity())));
}

TEST_CASE(
    "knife edge: just at the edge, where the formula changes, the loss is 6 dB from both sides") {
    CHECK(near(knife_edge_loss_db(0), 20 * std::log10(2.0), 1e-12));
    CHECK(near(knife_edge_loss_db(-1e-9), knife_edge_loss_db(1e-9), 1e-7));
}

TEST_CASE(
    "knife edge: far below the line of sight the formula of P.526 gives 0, not -145 dB (S16)") {
    for (const double nu : {-0.78, -1.0, -10.0, -1e4, -1e9}) {
        CHECK(knife_edge_loss_p526_db(nu) == 0);
        CHECK(near(knife_edge_loss_db(nu), 0, 1.4));
    }
    CHECK(near(knife_edge_loss_db(-1e9), 0, 1e-8));
    // The step where it is cut is 0.004 dB, and it is close to the exact loss from there on.
    CHECK(near(knife_edge_loss_p526_db(-0.78 + 1e-12), 0, 0.0041));
    for (double nu = -0.7799; nu < 20; nu += 0.01) {
        CHECK(near(knife_edge_loss_p526_db(nu), knife_edge_loss_db(nu), 0.13));
    }
}

TEST_CASE("transition function: real and imaginary part equal the test vectors (utd_transition)") {
    const Vectors vectors("utd_transition.csv");
    REQUIRE(vectors.size() == 22);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double x = vectors.number(i, "x");
        CAPTURE(x);
        CHECK(near(transition_function(x).real(), vectors.number(i, "Re_F"), 1e-12));
        CHECK(near(transition_function(x).imag(), vectors.number(i, "Im_F"), 1e-12));
    }
    CHECK(transition_function(0) == Complex{0});
}

TEST_CASE("wedge: the diffraction coefficient equals a published one (screen, k = 10, L = 1)") {
    const WedgePath path{2, {90 * degree}, {45 * degree}};
    const Complex soft = wedge_coefficient(path, 10, 1_m, soft_faces);
    const Complex hard = wedge_coefficient(path, 10, 1_m, hard_faces);
    CHECK(std::abs(soft - Complex{0.07634584116031007, -0.04771875264397031}) < 1e-14);
    CHECK(std::abs(hard - Complex{-0.17545379565978494, 0.14123983292699275}) < 1e-14);
}

TEST_CASE("wedge: the field around a screen equals Sommerfeld's exact field (utd_vs_exact)") {
    const auto rows = for_each_row(true, [](const Row& row) {
        for (const bool soft : {true, false}) {
            const Complex exact = soft ? row.soft : row.hard;
            const Complex ours = total_field(row.path, row.k, 1, soft ? soft_faces : hard_faces);
            CHECK(std::abs(ours - exact) < field_rounding);
            CHECK(near(decibels(ours), decibels(exact), 1e-9));
        }
    });
    CHECK(rows == 80);
}

TEST_CASE(
    "wedge: around a right angle the field is within 0.05 dB of the exact field (utd_vs_exact)") {
    const auto rows = for_each_row(false, [](const Row& row) {
        for (const bool soft : {true, false}) {
            const double exact = decibels(soft ? row.soft : row.hard);
            const Complex ours = total_field(row.path, row.k, 1, soft ? soft_faces : hard_faces);
            const double error = decibels(ours) - exact;
            CHECK(std::abs(error) < 0.05);
            // The theory's own error at this place, which an error of ours would add to.
            CHECK(near(error, soft ? row.soft_error : row.hard_error, 1e-6));
        }
    });
    CHECK(rows == 70);
}

TEST_CASE("wedge: at shadow and reflection boundaries the field is finite and continuous (S19)") {
    const double k = 50;
    for (const double n : {1.3, 1.5, 2.0}) {
        const double incident = 0.4 * n * pi;
        const double shadow = incident + pi, face_0 = pi - incident;
        const double face_n = (2 * n - 1) * pi - incident;
        for (const double boundary : {shadow, face_0, face_n}) {
            if (boundary < 0 || boundary > n * pi) continue;
            CAPTURE(n);
            CAPTURE(boundary);
            for (const WedgeFaces& faces :
                 {soft_faces, hard_faces, WedgeFaces{{-0.5, 0.2}, {0.3, -0.3}, {0.1, 0.4}}}) {
                const Complex here = total_field({n, {boundary}, {incident}}, k, 1, faces);
                const Complex above = total_field({n, {boundary + 1e-9}, {incident}}, k, 1, faces);
                const Complex below = total_field({n, {boundary - 1e-9}, {incident}}, k, 1, faces);
                CHECK(std::abs(here - above) < 1e-6);
                CHECK(std::abs(here - below) < 1e-6);
            }
        }
    }
}

TEST_CASE(
    "wedge: at a shadow boundary the field is the same with the direct ray lit or shadowed (S19)") {
    const WedgePath path{1.5, {0.3 + pi}, {0.3}};
    LitBy lit = lit_by(path);
    for (const WedgeFaces& faces : {soft_faces, hard_faces}) {
        lit.direct = true;
        const Complex with = total_field(path, 50, 1, faces, lit);
        lit.direct = false;
        CHECK(std::abs(total_field(path, 50, 1, faces, lit) - with) < 1e-12);
    }
}

TEST_CASE("wedge: a tenth of a degree from a boundary the field has no false peak of 36 dB (S20)") {
    // A theory that is not uniform (Keller's) has 36 dB there, see the vectors.
    for (const double phi_deg : {224.9, 225.1, 134.9, 135.1}) {
        const WedgePath path{1.5, {phi_deg * degree}, {45 * degree}};
        for (const WedgeFaces& faces : {soft_faces, hard_faces}) {
            CHECK(decibels(total_field(path, 50, 1, faces)) < 6.1);
        }
    }
}

TEST_CASE("wedge: an edge diffracts nothing if it is flat or lets everything through") {
    for (const double phi : {0.2, 1.5, 3.0}) {
        const WedgePath flat{1, {phi}, {1.1}};
        CHECK(std::abs(wedge_coefficient(flat, 50, 3_m, soft_faces)) < 1e-15);
        CHECK(std::abs(wedge_coefficient(flat, 50, 3_m, hard_faces)) < 1e-15);
        CHECK(wedge_coefficient({1.5, {phi}, {1.1}}, 50, 3_m, {0, 0, 1}) == Complex{0});
    }
    CHECK(wedge_coefficient({1.5, {3}, {1}}, 50, 0_m, hard_faces) == Complex{0});
}

TEST_CASE(
    "wedge: the coefficient is the same to the last bit if source and receiver are exchanged") {
    const auto reflection = [](Radians incidence) {  // of a dielectric half space, TE
        const double cosine = std::cos(incidence.value);
        const double root = std::sqrt(4 + cosine * cosine);
        return Complex{(cosine - root) / (cosine + root), 0.1};
    };
    for (const double n : {1.25, 1.5, 2.0}) {
        for (int i = 0; i <= 20; ++i) {
            for (int j = 0; j <= 20; ++j) {
                const WedgePath there{n, {n * pi * i / 20}, {n * pi * j / 20}};
                const WedgePath back{n, there.phi_incident, there.phi};
                const auto coefficient = [&](const WedgePath& path) {
                    const FaceIncidence at = face_incidence(path);
                    return wedge_coefficient(path, 51, 2_m,
                                             {reflection(at.face_0), reflection(at.face_n)});
                };
                CHECK(coefficient(there) == coefficient(back));
                CHECK(std::isfinite(std::abs(coefficient(there))));
            }
        }
    }
}

TEST_CASE("wedge: at a reflection boundary, the angle of incidence is that of the reflected ray") {
    const WedgePath face_0{1.5, {140 * degree}, {40 * degree}};
    CHECK(near(face_incidence(face_0).face_0.value, 50 * degree, 1e-14));
    const WedgePath face_n{1.5, {230 * degree}, {130 * degree}};
    CHECK(near(face_incidence(face_n).face_n.value, 50 * degree, 1e-14));
    // Behind the plane of a face the angle is mirrored by it.
    const WedgePath behind{2, {200 * degree}, {300 * degree}};
    CHECK(near(face_incidence(behind).face_0.value, 70 * degree, 1e-14));
}

TEST_CASE(
    "wedge: direct and reflected rays exist up to their shadow boundaries, boundaries included") {
    const LitBy low = lit_by({1.5, {100 * degree}, {45 * degree}});
    CHECK((low.direct && low.face_0 && !low.face_n));
    const LitBy between = lit_by({1.5, {150 * degree}, {45 * degree}});
    CHECK((between.direct && !between.face_0 && !between.face_n));
    const LitBy shadow = lit_by({1.5, {250 * degree}, {45 * degree}});
    CHECK((!shadow.direct && !shadow.face_0 && !shadow.face_n));
    const LitBy high = lit_by({1.5, {230 * degree}, {150 * degree}});
    CHECK((high.direct && !high.face_0 && high.face_n));
    CHECK(lit_by({2, {pi}, {0}}).direct);
    CHECK(lit_by({2, {pi / 2}, {pi / 2}}).face_0);
}

}  // namespace diffraction_test
