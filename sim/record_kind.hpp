// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Kinds of records, one bit each. A sink says once which it wants; a kind that no sink wants is
// never made: it costs the test of a bit.
//
//     KindMask kinds() const { return kind_of<Received>() | kind_levels; }
//
// Bits are fixed for ever, as fingerprints contain them: append, never renumber. A new kind needs
//   - a struct in sim/record.hpp, at the end of the variant Record,
//   - its name and the next bit here, below bit 29,
//   - the bytes that it adds to a fingerprint, in traces/fingerprint.cpp,
//   - somebody who emits it: World::emit.
// Requests are bits from 29 on. They are no records: a sink that has one gets more in a record of
// another kind, which costs every sink's run the work once.

namespace rovernet {

// Records, which sim/record.hpp defines; a mask needs their names only.
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

/// Set of kinds of records, and of what a sink asks for beside them.
using KindMask = std::uint32_t;

/// Kind of the records of type `T`: a mask of one bit, its place in the variant Record. A type that
/// is no record does not link.
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

/// Both records of links. They cost a search for link changes, which runs only if a sink wants
/// them.
inline constexpr KindMask kind_links = kind_of<LinkUp>() | kind_of<LinkDown>();

/// Request, not a record: Sent carries `reachable`, which costs a search of the network for each
/// message.
inline constexpr KindMask kind_reachable = 1U << 31;
/// Request as kind_reachable, but only as long as the searches are cheap beside the transmissions
/// (Reachability::cheap_searches); then it is given up for the rest of the run.
inline constexpr KindMask kind_cheap_reachable = 1U << 30;
/// Request, not a record: Received carries `levels`, which costs a look at each receiver of each
/// frame. A routing protocol asks for the same by its trait wants_levels.
inline constexpr KindMask kind_levels = 1U << 29;
/// All records, without the requests above.
inline constexpr KindMask kind_all = 0x1fffffff;

}  // namespace rovernet
