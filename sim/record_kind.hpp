// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Kinds of records, one bit each. A sink returns once which kinds it wants; if no sink wants a
// kind, emitting it costs only the test of a bit.
//
//     KindMask kinds() const { return kind_of<Received>() | kind_levels; }
//
// Bits are fixed for ever, because fingerprints contain them: append, never renumber. A new kind
// needs
//   - a struct in sim/record.hpp, at the end of the variant Record,
//   - its name and the next bit here, below bit 29,
//   - the bytes that it adds to a fingerprint, in traces/fingerprint.cpp,
//   - code that emits it: World::emit.
// Request bits, from 29 on, fill optional fields (reachable, levels) of other records; the work is
// done once for all sinks.

namespace rovernet {

// Record types, defined in sim/record.hpp; a mask needs only their names.
struct Sent;
struct Transmitted;
struct Received;
struct Dropped;
struct Moved;
struct Arrived;
struct NoWay;
struct Switched;
struct LinkUp;
struct LinkDown;
struct AirSent;
struct ControlReceived;
struct Routed;

/// Set of kinds of records and of requests.
using KindMask = std::uint32_t;

/// Kind of the records of type `T`: a mask with one bit, whose number is the index in the variant
/// Record. Other types do not link.
///
///   if (sink.kinds() & kind_of<Moved>()) ...
template <class T>
constexpr KindMask kind_of();
template <>
constexpr KindMask kind_of<Sent>() {
    return 1U << 0;
}
template <>
constexpr KindMask kind_of<Transmitted>() {
    return 1U << 1;
}
template <>
constexpr KindMask kind_of<Received>() {
    return 1U << 2;
}
template <>
constexpr KindMask kind_of<Dropped>() {
    return 1U << 3;
}
template <>
constexpr KindMask kind_of<Moved>() {
    return 1U << 4;
}
template <>
constexpr KindMask kind_of<Arrived>() {
    return 1U << 5;
}
template <>
constexpr KindMask kind_of<NoWay>() {
    return 1U << 6;
}
template <>
constexpr KindMask kind_of<Switched>() {
    return 1U << 7;
}

template <>
constexpr KindMask kind_of<LinkUp>() {
    return 1U << 8;
}
template <>
constexpr KindMask kind_of<LinkDown>() {
    return 1U << 9;
}
template <>
constexpr KindMask kind_of<AirSent>() {
    return 1U << 10;
}
template <>
constexpr KindMask kind_of<ControlReceived>() {
    return 1U << 11;
}
template <>
constexpr KindMask kind_of<Routed>() {
    return 1U << 12;
}

/// Both link records. They need a search for link changes, which runs only if a sink wants them.
inline constexpr KindMask kind_links = kind_of<LinkUp>() | kind_of<LinkDown>();

/// Request: fill Sent::reachable. It costs a search of the network for each message.
inline constexpr KindMask kind_reachable = 1U << 31;
/// Request: fill Sent::reachable while the searches are cheap compared with the transmissions
/// (Reachability::cheap_searches); after that it stays empty for the rest of the run.
inline constexpr KindMask kind_cheap_reachable = 1U << 30;
/// Request: fill Received::levels. It costs the level at each receiver of each frame. A routing
/// protocol requests levels by its trait wants_levels.
inline constexpr KindMask kind_levels = 1U << 29;
/// All records, without requests.
inline constexpr KindMask kind_all = 0x1fffffff;

}  // namespace rovernet
