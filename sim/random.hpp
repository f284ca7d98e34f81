// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace rovernet {

/// What a random number is for. Values are fixed for ever: append, never renumber.
enum class Purpose : std::uint16_t {
    flood_jitter = 1,
    link_shadowing = 2,
    placement = 3,
    order = 4,
    destination = 5,
    movement = 6,
    link_success = 7,
    backoff = 8,
    bit_errors = 9,
    traffic_source = 10,
    routing_jitter = 11,
};

/// The meaning of one draw, and all that decides it: the same key gives the same number, in any
/// order and from any thread; keys that differ in any field give independent numbers.
struct Key {
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
    Purpose purpose{};
    std::uint64_t a = 0;      ///< what the draw is about (a robot's name_key, say) ...
    std::uint64_t b = 0;      ///< ... and with what (a packet, the other robot); order matters
    std::uint64_t index = 0;  ///< which of several such draws, from 0
};

/// 64 random bits: Philox4x32-10 over the counter (a, b), under a key mixed from the other fields.
///
/// Two keys that differ in a and b only, or in one field only, never share a Philox block; any
/// other two do with probability 2^-64.
std::uint64_t bits(const Key& key);

/// Uniform in the open interval (0, 1): a midpoint (i + 1/2) 2^-52, never 0 or 1; u and 1 - u are
/// both exact.
double uniform(const Key& key);

/// Standard normal, mean 0 and standard deviation 1: normal_quantile(uniform(key)); |x| < 8.21.
double normal(const Key& key);

/// Exponential with mean 1: -log(uniform(key)), between 1.1e-16 and 36.8.
double exponential(const Key& key);

/// Uniform in 0 ... n-1, n > 0: the high word of bits * n (D. Lemire, ACM TOMACS 29(1), 2019).
///
/// Without rejection, so that one key is one draw: each value's probability is within 2^-64 of 1/n,
/// a relative bias below n 2^-64.
std::uint64_t below(const Key& key, std::uint64_t n);

/// The standard normal's inverse distribution function, for 0 < p < 1; relative error < 2e-15.
///
/// Source: M. J. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37(3), 1988.
double normal_quantile(double p);

/// A name as a key: XXH64 with seed 0 of its bytes.
std::uint64_t name_key(std::string_view name);

/// The finaliser of splitmix64: one-to-one, and each bit of x moves half of the result's.
///
/// Source: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, OOPSLA
/// 2014; constants of D. Stafford's variant 13.
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

/// Two keys as one, order-dependent: mix(mix(first + 2^64 / golden ratio) + second), with the
/// finaliser of splitmix64. One-to-one in either argument while the other stays.
constexpr std::uint64_t combine(std::uint64_t first, std::uint64_t second) {
    return mix(mix(first + 0x9e3779b97f4a7c15) + second);
}

/// One draw for each unordered pair of keys, for when a run asks for more of them than Philox can
/// give: mix(mix(s + a) + mix(s + b)), with s made of seed, replication and purpose.
///
/// The same from a to b as from b to a. Pairs that share a key draw independently, and so do all
/// the pairs of three or four keys together. Two pairs share a draw with probability 2^-64.
class PairDraws {
  public:
    PairDraws(std::uint64_t seed, std::uint32_t replication, Purpose purpose);

    /// What one key adds to a pair, for when it is in many.
    std::uint64_t share(std::uint64_t key) const { return mix(stream_ + key); }
    static std::uint64_t bits_of_shares(std::uint64_t a, std::uint64_t b) { return mix(a + b); }
    std::uint64_t bits(std::uint64_t a, std::uint64_t b) const {
        return bits_of_shares(share(a), share(b));
    }
    double uniform(std::uint64_t a, std::uint64_t b) const;  ///< as uniform() of these bits
    double normal(std::uint64_t a, std::uint64_t b) const { return normal_of(bits(a, b)); }
    static double normal_of(std::uint64_t bits);  ///< as normal() of these bits

  private:
    std::uint64_t stream_;
};

/// The Philox4x32 bijection of ten rounds: `counter` enciphered under `key`.
///
/// Source: J. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC11, section 4.
std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key);

}  // namespace rovernet
