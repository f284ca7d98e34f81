// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

// Random numbers without a generator state: each draw is a function of a key that describes its
// use. An additional draw changes no other draw, in any order and any thread.

namespace rovernet {

/// Purpose of a random number. Results depend on the values: append enumerators, never renumber.
/// The comment of each purpose ends with the values of Key::a and Key::b for its draws.
enum class Purpose : std::uint16_t {
    /// Delay before a flood forwards a copy. Key::a = robot key, Key::b = message key.
    flood_jitter = 1,
    /// Shadowing of a pair of robots [standard normal]. Key::a = smaller robot key, Key::b =
    /// larger robot key.
    link_shadowing = 2,
    /// Start position of a robot in an area. Key::a = robot key.
    placement = 3,
    /// Order of a robot's shuffled waypoints. Key::a = robot key, Key::b = 0 for the robot's table
    /// `move`, n for the movement that the robot's n-th reaction starts.
    order = 4,
    /// Choice of a robot's goal among several. Key::a = robot key, Key::b = 0 for the robot's table
    /// `move`, n for the movement that the robot's n-th reaction starts.
    destination = 5,
    /// Draws of movement models. Key::a = robot key, Key::b = number of the robot's movement.
    movement = 6,
    /// Loss of a frame by its sender's success rate. Key::a = key of the robot pair, Key::b = key
    /// of message and path.
    link_success = 7,
    /// Number of backoff slots of the DCF. Key::a = robot key.
    backoff = 8,
    /// Loss of a frame by its error rate. Key::a = key of the robot pair, Key::b = number of the
    /// frame.
    bit_errors = 9,
    /// Choice of the sender of a message, for a flow whose messages may start at any robot.
    /// Key::a = key of the flow's name.
    traffic_source = 10,
    /// Delays and choices of a routing protocol that has no purposes of its own. Key::a = robot
    /// key, Key::b = message key.
    routing_jitter = 11,
    /// Time at which links are sampled for a fit [fraction of the duration].
    sample_time = 15,
    /// Random waves whose sum is the shadowing field. Key::a = number of the wave.
    field_shadowing = 16,
    /// Fading of a frame at a receiver. Key::a = frame key, Key::b = receiver key.
    frame_fading = 17,
    /// Random waves whose sum is a fading field. Key::a = number of the wave, Key::b = number of
    /// the field (only nakagami can have several).
    place_fading = 18,
    /// Times of a routing protocol's HELLO packets. Key::a = robot key.
    hello = 19,
    /// Time that a flood waits to assess whether to forward. Key::a = robot key, Key::b = message
    /// key.
    assessment = 20,
    /// Slot in which a relay forwards. Key::a = robot key, Key::b = message key.
    relay_slot = 21,
    /// Choice among several routes. Key::a = robot key, Key::b = message key.
    route_choice = 22,
};

/// Key of one draw, which determines the number: equal keys give equal numbers, in any order and
/// from any thread; keys that differ in any field give independent numbers.
///
///   uniform({.seed = 1, .purpose = Purpose::placement, .a = name_key("A"), .index = 0})
struct Key {
    /// Seed of the run's random draws.
    std::uint64_t seed = 0;
    /// Number of the run's independent repetition (replication).
    std::uint32_t replication = 0;
    /// Purpose of the draw.
    Purpose purpose{};
    /// Subject of the draw, such as a robot's name_key.
    std::uint64_t a = 0;
    /// Second subject: a packet, or the second robot. Exchanging a and b gives a different number.
    std::uint64_t b = 0;
    /// Index among several draws whose other fields are equal, from 0.
    std::uint64_t index = 0;
};

/// Random number of 64 bits: output of the generator Philox4x32-10 for the counter (a, b), with a
/// cipher key that is mixed from the other fields of `key`.
///
/// Two keys that differ only in a and b, or in only one field, never share an output block of
/// Philox. Any other two keys share a block with probability 2^-64.
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
/// There is no rejection: one key gives one draw. The probability of each value is within 2^-64 of
/// 1/n, a relative bias below n 2^-64.
std::uint64_t below(const Key& key, std::uint64_t n);

/// Inverse distribution function of the standard normal, for 0 < p < 1; relative error < 2e-15.
///
/// Source: M. J. Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37(3), 1988.
double normal_quantile(double p);

/// Key of a name: XXH64 of its bytes, with seed 0. Keys of robots and flows are made of their
/// names.
std::uint64_t name_key(std::string_view name);

/// Finaliser of splitmix64: a one-to-one function; a change of one bit of x changes each bit of the
/// result with probability near 1/2.
///
/// Source: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number generators, OOPSLA
/// 2014; constants of D. Stafford's variant 13.
constexpr std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

/// Key made of two keys, whose order matters: mix(mix(first + 2^64 / golden ratio) + second), with
/// the finaliser of splitmix64. One-to-one in each argument for a fixed other argument.
constexpr std::uint64_t combine(std::uint64_t first, std::uint64_t second) {
    return mix(mix(first + 0x9e3779b97f4a7c15) + second);
}

/// Draws for unordered pairs of keys, one for each pair; faster than Philox, for runs with very
/// many pairs: mix(mix(s + a) + mix(s + b)), with s made of seed, replication and purpose.
///
/// The draw is the same in both orders. Draws of pairs that share a key are independent, and so are
/// the draws of all pairs among three or four keys. Two pairs have the same draw with probability
/// 2^-64. Shadowing of links uses one draw for each pair of robots.
class PairDraws {
  public:
    /// Creates the draws of a run for one purpose.
    PairDraws(std::uint64_t seed, std::uint32_t replication, Purpose purpose);

    /// Contribution of one key to the draw of each of its pairs, for a caller that stores it.
    std::uint64_t share(std::uint64_t key) const { return mix(stream_ + key); }
    /// Random bits (64) of a pair, from the contributions of its two keys.
    static std::uint64_t bits_of_shares(std::uint64_t a, std::uint64_t b) { return mix(a + b); }
    /// Random bits (64) of a pair of keys.
    std::uint64_t bits(std::uint64_t a, std::uint64_t b) const {
        return bits_of_shares(share(a), share(b));
    }
    /// Uniform draw in (0, 1) of a pair of keys, from its random bits.
    double uniform(std::uint64_t a, std::uint64_t b) const;
    /// Standard normal draw of a pair of keys, from its random bits.
    double normal(std::uint64_t a, std::uint64_t b) const { return normal_of(bits(a, b)); }
    /// Standard normal draw for the random bits of a pair.
    static double normal_of(std::uint64_t bits);

  private:
    // Number s made of seed, replication and purpose, which all pairs share.
    std::uint64_t stream_;
};

/// Philox4x32 bijection of ten rounds: encrypts `counter` with `key`.
///
/// Source: J. Salmon et al., Parallel random numbers: as easy as 1, 2, 3, SC11, section 4.
std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key);

}  // namespace rovernet
