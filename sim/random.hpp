// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

// Random numbers without a generator: each draw is a function of a key that says what it is for. No
// state is passed on, so that a draw more or less changes no other, in any order and thread.

namespace rovernet {

/// Purpose of a random number. The values are fixed for ever, as results depend on them: append,
/// never renumber. Behind each: what the fields a and b of its keys are.
enum class Purpose : std::uint16_t {
    /// Delay before a flood forwards a copy. Robot, message.
    flood_jitter = 1,
    /// Shadowing of a pair of robots [standard normal]. The smaller of their keys, the larger.
    link_shadowing = 2,
    /// Start of a robot in an area. Robot.
    placement = 3,
    /// Order of a robot's waypoints that are shuffled. Robot, number of the plan.
    order = 4,
    /// Choice of a robot's goal among several. Robot, number of the plan.
    destination = 5,
    /// Draws of movement models. Robot, number of its movement.
    movement = 6,
    /// Loss of a frame by its sender's success rate. Pair of robots, message and path.
    link_success = 7,
    /// Number of slots of a backoff of the DCF. Robot.
    backoff = 8,
    /// Loss of a frame by its error rate. Pair of robots, number of the frame.
    bit_errors = 9,
    /// Sender of a message of a flow from any robot. Name of the flow.
    traffic_source = 10,
    /// Delays and choices of other routing protocols. Robot, message.
    routing_jitter = 11,
    /// Time at which links are sampled for a fit [share of the duration].
    sample_time = 15,
    /// Waves of the field of shadowing. Number of the wave.
    field_shadowing = 16,
    /// Fade of a frame at a receiver. Frame and robot, see Fades.
    frame_fading = 17,
    /// Waves of the field of fading. Number of the wave.
    place_fading = 18,
};

/// Key of one draw, which alone decides it: equal keys give equal numbers, in any order and from
/// any thread; keys that differ in any field give independent numbers.
///
///   uniform({.seed = 1, .purpose = Purpose::placement, .a = name_key("A"), .index = 0})
struct Key {
    /// Seed of the run.
    std::uint64_t seed = 0;
    /// Number of the independent repetition.
    std::uint32_t replication = 0;
    /// Purpose of the number.
    Purpose purpose{};
    /// Subject of the draw: a robot's name_key, say.
    std::uint64_t a = 0;
    /// Second subject: a packet, or the other robot. Exchanging a and b gives another number.
    std::uint64_t b = 0;
    /// Number among several such draws, from 0.
    std::uint64_t index = 0;
};

/// 64 random bits: Philox4x32-10 over the counter (a, b), under a key mixed from the other fields.
///
/// Two keys that differ in a and b only, or in one field only, never share a Philox block; any
/// other two do with probability 2^-64.
std::uint64_t bits(const Key& key);

/// Uniform draw in the open interval (0, 1): a midpoint (i + 1/2) 2^-52, never 0 or 1; u and 1 - u
/// are both exact.
double uniform(const Key& key);

/// Standard normal draw, mean 0 and standard deviation 1: normal_quantile(uniform(key)); |x| <
/// 8.21.
double normal(const Key& key);

/// Exponential draw with mean 1: -log(uniform(key)), between 1.1e-16 and 36.8.
double exponential(const Key& key);

/// Uniform draw in 0 ... n-1, n > 0: the high word of bits * n (D. Lemire, ACM TOMACS 29(1), 2019).
///
/// There is no rejection, so that one key is one draw: each value's probability is within 2^-64 of
/// 1/n, a relative bias below n 2^-64.
std::uint64_t below(const Key& key, std::uint64_t n);

/// Inverse distribution function of the standard normal, for 0 < p < 1; relative error < 2e-15.
///
/// Source: M. J. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37(3), 1988.
double normal_quantile(double p);

/// Key of a name: XXH64 of its bytes, with seed 0. Robots and flows have their keys from it.
std::uint64_t name_key(std::string_view name);

/// Finaliser of splitmix64: one-to-one, and a change of one bit of x changes each bit of the result
/// with probability near 1/2.
///
/// Source: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, OOPSLA
/// 2014; constants of D. Stafford's variant 13.
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

/// Key made of two keys, whose order counts: mix(mix(first + 2^64 / golden ratio) + second), with
/// the finaliser of splitmix64. One-to-one in either argument while the other stays.
constexpr std::uint64_t combine(std::uint64_t first, std::uint64_t second) {
    return mix(mix(first + 0x9e3779b97f4a7c15) + second);
}

/// Draws for unordered pairs of keys, one for each, for when a run asks for more of them than
/// Philox can give: mix(mix(s + a) + mix(s + b)), with s made of seed, replication and purpose.
///
/// The draw from a to b is the one from b to a. Pairs that share a key draw independently, and so
/// do all the pairs of three or four keys together. Two pairs share a draw with probability 2^-64.
/// Shadowing of links uses it: one draw for each pair of robots.
class PairDraws {
  public:
    /// Draws of a run for a purpose.
    PairDraws(std::uint64_t seed, std::uint32_t replication, Purpose purpose);

    /// Part that one key adds to each of its pairs, for a caller that keeps it.
    std::uint64_t share(std::uint64_t key) const { return mix(stream_ + key); }
    /// 64 random bits of the pair that these parts belong to.
    static std::uint64_t bits_of_shares(std::uint64_t a, std::uint64_t b) { return mix(a + b); }
    /// 64 random bits of a pair of keys.
    std::uint64_t bits(std::uint64_t a, std::uint64_t b) const {
        return bits_of_shares(share(a), share(b));
    }
    /// Uniform draw of a pair, as uniform() of these bits.
    double uniform(std::uint64_t a, std::uint64_t b) const;
    /// Standard normal draw of a pair, as normal() of these bits.
    double normal(std::uint64_t a, std::uint64_t b) const { return normal_of(bits(a, b)); }
    /// Standard normal draw for bits of a pair.
    static double normal_of(std::uint64_t bits);

  private:
    // Part of the key that all pairs share: s.
    std::uint64_t stream_;
};

/// Philox4x32 bijection of ten rounds: `counter` enciphered under `key`.
///
/// Source: J. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC11, section 4.
std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key);

}  // namespace rovernet
