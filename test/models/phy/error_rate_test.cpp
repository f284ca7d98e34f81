// SPDX-License-Identifier: MIT
#include "models/phy/error_rate.hpp"

#include "sim/random.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace error_rate_test {
using namespace rovernet;

namespace {

constexpr double vector_accuracy = 1e-9;   // relative; as the vectors' README states
constexpr double stated_accuracy = 1e-10;  // relative; as error_rate.hpp states

constexpr std::array all{Modulation::dsss_1,  Modulation::dsss_2,  Modulation::cck_5_5,
                         Modulation::cck_11,  Modulation::ofdm_6,  Modulation::ofdm_9,
                         Modulation::ofdm_12, Modulation::ofdm_18, Modulation::ofdm_24,
                         Modulation::ofdm_36, Modulation::ofdm_48, Modulation::ofdm_54};

double ratio(double db) { return std::pow(10, db / 10); }

/// Of a frame of so many bits.
double packet_error(Modulation modulation, double db, int bits) {
    return -std::expm1(bits * log_success(modulation, ratio(db)));
}

bool close(double a, double b, double relative) {
    return std::abs(a - b) <= relative * std::abs(b);
}

}  // namespace

TEST_CASE(
    "error rate: the error rates of frames of 1000 bytes, and of bits, equal the test vectors") {
    const test::Vectors vectors("per_1000B.csv");
    int compared = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const std::string& mode = vectors.text(i, "mode");
        // Another model of the same modulation, which ours is not: it counts one weight and soft
        // decisions.
        if (mode.find("Yans") != mode.npos) continue;
        const Modulation modulation = mode.starts_with("DSSS 1")   ? Modulation::dsss_1
                                      : mode.starts_with("DSSS 2") ? Modulation::dsss_2
                                                                   : Modulation::ofdm_6;
        const double db = vectors.number(i, "SINR_dB");
        CAPTURE(mode);
        CAPTURE(db);
        CHECK(close(packet_error(modulation, db, 8000), vectors.number(i, "PER_8000bits"),
                    vector_accuracy));
        const bool coded = modulation == Modulation::ofdm_6;
        const double bit = vectors.number(i, coded ? "coded_bit_err(union bound)" : "raw_BER");
        CHECK(close(bit_error_rate(modulation, ratio(db)), std::min(bit, 0.5), vector_accuracy));
        ++compared;
    }
    CHECK(compared == 47);
}

TEST_CASE("error rate: the success rates of frames equal those in the tests of ns-3") {
    struct Row {
        Modulation modulation;
        double db;       // SINR of OFDM, level of DSSS [dBm]
        double success;  // of 16000 bits of OFDM, 8624 bits of DSSS
        double digit;    // the last one that is given, and not rounded
    };
    using enum Modulation;
    const Row rows[] = {
        {dsss_1, -99, 3e-4, 1e-4},     {dsss_1, -98, .202, 1e-3},      {dsss_1, -97, .813, 1e-3},
        {dsss_1, -96, .984, 1e-3},     {dsss_1, -95, .999, 1e-3},      {dsss_2, -95, 4.5e-6, 1e-7},
        {dsss_2, -94, .036, 1e-3},     {dsss_2, -93, .519, 1e-3},      {dsss_2, -92, .915, 1e-3},
        {dsss_2, -91, .993, 1e-3},     {ofdm_6, 2.5, 2.04e-10, 1e-12}, {ofdm_6, 3, .020, 1e-3},
        {ofdm_6, 4, .885, 1e-3},       {ofdm_6, 5, .997, 1e-3},        {ofdm_9, 6, .097, 1e-3},
        {ofdm_9, 7, .918, 1e-3},       {ofdm_12, 6, .0174, 1e-4},      {ofdm_12, 7, .881, 1e-3},
        {ofdm_18, 8.5, 2.85e-6, 1e-8}, {ofdm_18, 9.5, .623, 1e-3},     {ofdm_24, 13, .495, 1e-3},
        {ofdm_36, 16.5, .818, 1e-3},   {ofdm_48, 21, .649, 1e-3},      {ofdm_54, 22, .410, 1e-3},
        {ofdm_54, 23, .958, 1e-3},
    };
    for (const Row& row : rows) {
        const bool dsss = row.modulation < ofdm_6;
        const double noise = -100.5522786 + 7;  // [dBm] the peer's, of 22 MHz
        const double S = ratio(dsss ? row.db - noise : row.db);
        const double got = success((dsss ? 8624 : 16000) * log_success(row.modulation, S));
        CAPTURE(static_cast<int>(row.modulation));
        CAPTURE(row.db);
        CHECK(test::near(got, row.success, row.digit));
    }
}

TEST_CASE("error rate: bit error rates are at most 1/2, and probabilities of success at most 1") {
    const double inf = std::numeric_limits<double>::infinity();
    for (const Modulation modulation : all) {
        CAPTURE(static_cast<int>(modulation));
        for (const double S : {0.0, -1.0, -inf, std::numeric_limits<double>::quiet_NaN()}) {
            CHECK(bit_error_rate(modulation, S) == 0.5);
            CHECK(test::near(log_success(modulation, S), std::log(0.5), 1e-15));
        }
        // DSSS 2's equation gives 0.56 at -15 dB, 1.06 at -19 dB, 2.02 at -24.5 dB.
        for (double db = -400; db < 100; db += 0.37) {
            const double p = bit_error_rate(modulation, ratio(db));
            CHECK(p >= 0);
            CHECK(p <= 0.5);
            CHECK(packet_error(modulation, db, 8000) <= 1);
        }
        CHECK(packet_error(modulation, -30, 8000) == 1);
        CHECK(bit_error_rate(modulation, inf) == 0);
        CHECK(success(8000 * log_success(modulation, inf)) == 1);
    }
}

TEST_CASE("error rate: a stronger signal never has more errors") {
    for (const Modulation modulation : all) {
        CAPTURE(static_cast<int>(modulation));
        double before = 0.5;
        for (double db = -30; db < 45; db += 0.01) {
            const double p = bit_error_rate(modulation, ratio(db));
            CHECK(p <= before);
            before = p;
        }
    }
}

TEST_CASE("error rate: bit error rates below 1e-16 are not lost in the logarithm of success") {
    // 1 - p is 1 in doubles here; a frame is lost with n p.
    for (const Modulation modulation : all) {
        double db = -10;
        while (bit_error_rate(modulation, ratio(db)) > 1e-18) db += 0.25;
        const double p = bit_error_rate(modulation, ratio(db));
        CAPTURE(static_cast<int>(modulation));
        CHECK(p > 1e-30);
        CHECK(close(packet_error(modulation, db, 8000), 8000 * p, 1e-12));
    }
}

TEST_CASE("error rate: a frame's success probability is the product of those of its parts") {
    const double header = 192 * log_success(Modulation::dsss_1, ratio(-4));
    const double body = 4000 * log_success(Modulation::cck_11, ratio(5.5));
    constexpr double roundings = 1e-14;  // relative
    CHECK(close(success(header + body), success(header) * success(body), roundings));
    CHECK(test::near(log_success(Modulation::ofdm_6, ratio(2)),
                     std::log1p(-bit_error_rate(Modulation::ofdm_6, ratio(2))), roundings));
}

TEST_CASE("error rate: each bit rate of 802.11 has its modulation, and other rates have none") {
    const std::array rates{1.0, 2.0, 5.5, 11.0, 6.0, 9.0, 12.0, 18.0, 24.0, 36.0, 48.0, 54.0};
    for (std::size_t i = 0; i < rates.size(); ++i) {
        CHECK(modulation_of({rates[i] * 1e6}) == all[i]);
    }
    for (const double other : {0.0, 1.0, 3e6, 5.5e6 + 1, 6e9, -1e6, std::nan("")}) {
        CHECK_FALSE(modulation_of({other}));
    }
}

namespace {

/// The error of 16 bi-orthogonal signals, by Simpson's rule with steps of 0.003 to 0.009.
long double symbol_error(long double b) {
    const long double from = -b, to = -b / 2 + 12;
    constexpr int steps = 4000;
    const long double h = (to - from) / steps;
    long double sum = 0;
    for (int i = 0; i <= steps; ++i) {
        const long double x = from + i * h;
        const long double lost = -std::expm1(7 * std::log1p(-std::erfc((x + b) / std::sqrt(2.0L))));
        const int weight = i == 0 || i == steps ? 1 : i % 2 == 0 ? 2 : 4;
        sum += weight * lost * std::exp(-x * x / 2);
    }
    return sum * h / 3 / std::sqrt(2 * 3.14159265358979323846L) +
           std::erfc(b / std::sqrt(2.0L)) / 2;  // the opposite signal wins
}

using Word = std::array<std::complex<double>, 8>;

/// A code word from its four phases in quarter turns. IEEE 802.11-2020, 16.4.6.6.
Word word(int p1, int p2, int p3, int p4) {
    const auto chip = [](int quarters) {
        constexpr std::array<std::complex<double>, 4> turn{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        return turn[static_cast<std::size_t>(quarters % 4)];
    };
    return {chip(p1 + p2 + p3 + p4), chip(p1 + p3 + p4), chip(p1 + p2 + p4), -chip(p1 + p4),
            chip(p1 + p2 + p3),      chip(p1 + p3),      -chip(p1 + p2),     chip(p1)};
}

std::vector<Word> words_of_5_5() {
    std::vector<Word> words;
    for (int i = 0; i < 16; ++i) words.push_back(word(i % 4, i & 4 ? 3 : 1, 0, i & 8 ? 2 : 0));
    return words;
}

std::vector<Word> words_of_11() {
    std::vector<Word> words;
    for (int i = 0; i < 256; ++i) words.push_back(word(i % 4, i / 4 % 4, i / 16 % 4, i / 64));
    return words;
}

/// Share of the symbols that an ideal coherent receiver takes for another word.
double drawn_symbol_error(const std::vector<Word>& words, double Es_over_N0, int symbols) {
    const double sigma = std::sqrt(8 / Es_over_N0 / 2);
    int wrong = 0;
    for (int n = 0; n < symbols; ++n) {
        Word heard = words[static_cast<std::size_t>(n) % words.size()];
        for (std::uint64_t i = 0; i < 8; ++i) {
            const auto noise = [&](std::uint64_t part) {
                return sigma * normal({.purpose = Purpose::order,
                                       .a = static_cast<std::uint64_t>(n),
                                       .b = part,
                                       .index = i});
            };
            heard[i] += std::complex<double>(noise(0), noise(1));
        }
        std::size_t best = 0;
        double most = -1e9;
        for (std::size_t k = 0; k < words.size(); ++k) {
            double match = 0;
            for (std::size_t i = 0; i < 8; ++i)
                match += std::real(heard[i] * std::conj(words[k][i]));
            if (match > most) {
                most = match;
                best = k;
            }
        }
        wrong += best != static_cast<std::size_t>(n) % words.size();
    }
    return static_cast<double>(wrong) / symbols;
}

}  // namespace

TEST_CASE(
    "cck: the error rate at 5.5 Mb/s equals the integral of Pursley and Royster, down to 1e-220") {
    for (const double b : {0.01, 0.5, 1.0, 2.0, 3.0, 4.5, 5.9, 6.1, 8.0, 10.0, 11.9, 12.1, 15.0,
                           18.0, 20.9, 21.1, 30.0, 45.0}) {
        const double S = b * b / 16;
        const long double exact = -std::expm1(std::log1p(-symbol_error(b)) / 4);
        CAPTURE(b);
        CHECK(close(bit_error_rate(Modulation::cck_5_5, S), static_cast<double>(exact),
                    stated_accuracy));
    }
}

TEST_CASE(
    "cck: an ideal coherent receiver of the standard's code words needs 3 dB less than the model") {
    constexpr int symbols = 20'000;
    for (const double db : {-2.0, 0.0, 2.0}) {
        const double S = ratio(db);
        const double ideal_Es_over_N0 = 16 * S / 2;
        const double model = 1 - success(4 * log_success(Modulation::cck_5_5, S));
        const double drawn = drawn_symbol_error(words_of_5_5(), ideal_Es_over_N0, symbols);
        CAPTURE(db);
        CHECK(test::near(drawn, model, 4 * std::sqrt(model * (1 - model) / symbols)));
    }
}

TEST_CASE("cck: modelling the 256 code words of 11 Mb/s as two sets of 16 is right within 0.2 dB") {
    constexpr int symbols = 20'000;
    for (const double db : {1.0, 3.0}) {
        const auto model = [](double at_db) {
            return 1 - success(8 * log_success(Modulation::cck_11, ratio(at_db)));
        };
        const double drawn = drawn_symbol_error(words_of_11(), 16 * ratio(db) / 2, symbols);
        const double sigma = std::sqrt(drawn * (1 - drawn) / symbols);
        CAPTURE(db);
        CHECK(drawn < model(db) + 4 * sigma);
        CHECK(drawn > model(db + 0.2) - 4 * sigma);
    }
}

TEST_CASE("cck: the bit error rate at 11 Mb/s equals that at 5.5 Mb/s with half the SINR") {
    for (double db = -20; db < 15; db += 0.5) {
        CHECK(bit_error_rate(Modulation::cck_11, 2 * ratio(db)) ==
              bit_error_rate(Modulation::cck_5_5, ratio(db)));
    }
}

TEST_CASE("cck: without a signal, a symbol is right with probability 1/16 or, at 11 Mb/s, 1/256") {
    constexpr double faint = 1e-12;
    CHECK(test::near(success(4 * log_success(Modulation::cck_5_5, faint)), 1.0 / 16, 1e-5));
    CHECK(test::near(success(8 * log_success(Modulation::cck_11, faint)), 1.0 / 256, 1e-5));
}

namespace {

/// Which of the two coded bits of the n-th bit (n = 0 ... k - 1, then again) are sent.
struct Puncturing {
    std::vector<bool> first, second;
};

constexpr std::size_t states = 64;
using ByWeight = std::vector<double>;

/// Paths in one state, and the wrong bits on them, by the number of sent bits that differ.
struct Paths {
    ByWeight count, wrong;
    explicit Paths(std::size_t size) : count(size), wrong(size) {}

    /// Adds the paths of `before` after one more bit.
    void extend(const Paths& before, unsigned bit, std::size_t weight) {
        for (std::size_t d = weight; d < count.size(); ++d) {
            count[d] += before.count[d - weight];
            wrong[d] += before.wrong[d - weight] + bit * before.count[d - weight];
        }
    }
};

/// Wrong bits on all paths of the code (133, 171) that leave the right one within the first block
/// of k bits, are back on it at the end of a block, and differ from it in d sent bits, for d <
/// size.
ByWeight wrong_bits(const Puncturing& sent, std::size_t size) {
    const std::size_t k = sent.first.size();
    ByWeight total(size);
    std::vector<Paths> at(states, Paths(size));
    at[0].count[0] = 1;
    constexpr std::size_t steps = 300;  // far more than a path of such a weight can have
    for (std::size_t step = 0; step < steps; ++step) {
        const std::size_t n = step % k;
        std::vector<Paths> next(states, Paths(size));
        for (unsigned state = 0; state < states; ++state) {
            for (const unsigned bit : {0u, 1u}) {
                const unsigned shift = bit << 6 | state;  // the newest bit on the left
                const int weight = (sent.first[n] ? std::popcount(shift & 0133u) % 2 : 0) +
                                   (sent.second[n] ? std::popcount(shift & 0171u) % 2 : 0);
                next[shift >> 1].extend(at[state], bit, static_cast<std::size_t>(weight));
            }
        }
        if (n == k - 1) {
            for (std::size_t d = 0; d < size; ++d) total[d] += next[0].wrong[d];
            next[0] = Paths(size);
        }
        at = std::move(next);
    }
    return total;
}

struct Code {
    Puncturing sent;
    std::size_t weights;  // one more than the largest in the bound
};
// IEEE 802.11-2020, 17.3.5.6.
const Code half{{{true}, {true}}, 27};
const Code two_thirds{{{true, true}, {true, false}}, 16};
const Code three_quarters{{{true, true, false}, {true, false, true}}, 15};

}  // namespace

TEST_CASE(
    "ofdm: for each convolutional code, the bit error bound sums over the lowest path weights") {
    struct Row {
        Modulation modulation;
        const Code& code;
        double share, spread;
        double from_db;
    };
    using enum Modulation;
    const Row rows[] = {{ofdm_6, half, 1, 1, 2},
                        {ofdm_9, three_quarters, 1, 1, 6},
                        {ofdm_12, half, 1, 2, 5},
                        {ofdm_18, three_quarters, 1, 2, 9},
                        {ofdm_24, half, 0.75, 10, 11},
                        {ofdm_36, three_quarters, 0.75, 10, 15},
                        {ofdm_48, two_thirds, 7.0 / 12, 42, 20},
                        {ofdm_54, three_quarters, 7.0 / 12, 42, 21}};
    for (const Row& row : rows) {
        const ByWeight wrong = wrong_bits(row.code.sent, row.code.weights);
        const double k = static_cast<double>(row.code.sent.first.size());
        for (double db = row.from_db; db < row.from_db + 8; db += 0.5) {
            const double p = row.share / 2 * std::erfc(std::sqrt(ratio(db) / row.spread));
            const double D = std::sqrt(4 * p * (1 - p));
            double sum = 0;
            for (std::size_t d = 0; d < wrong.size(); ++d) {
                sum += wrong[d] * std::pow(D, static_cast<double>(d)) / (2 * k);
            }
            CAPTURE(static_cast<int>(row.modulation));
            CAPTURE(db);
            CHECK(close(bit_error_rate(row.modulation, ratio(db)), sum, stated_accuracy));
        }
    }
}

TEST_CASE("error rate: with every compiler, error and success rates are equal to the last bit") {
    std::uint64_t sum = 0;
    for (const Modulation modulation : all) {
        for (int i = -300; i < 400; ++i) {
            const double S = std::ldexp(1 + 0.001 * (i + 300), i / 30);
            sum = combine(sum, std::bit_cast<std::uint64_t>(bit_error_rate(modulation, S)));
            sum = combine(sum, std::bit_cast<std::uint64_t>(log_success(modulation, S)));
        }
    }
    CHECK(sum == 0x478273263e15067e);
}

TEST_CASE(
    "error rate: at the SINR `certain_sinr` every frame succeeds; 1 dB below it a frame may fail") {
    constexpr double bits = 8 * 0x1p32;
    for (const Modulation modulation : all) {
        CAPTURE(static_cast<int>(modulation));
        const double certain = certain_sinr(modulation).value;
        for (const double more : {0.0, 0.01, 1.0, 10.0, 100.0}) {
            CHECK(success(bits * log_success(modulation, ratio(certain + more))) == 1);
        }
        CHECK(success(bits * log_success(modulation, ratio(certain - 1))) < 1);
    }
}

}  // namespace error_rate_test
