// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

// Kinds of records, one bit each. A sink returns once which kinds it wants; if no sink wants a
// kind, emitting a record of this kind costs only the test of a bit.
//
//     KindMask kinds() const { return kind_of<Received>() | kind_levels; }
//
// A new kind needs
//   - a struct in sim/record.hpp, with its name and its fields(),
//   - a place at the end of RecordKinds below,
//   - code that emits it: World::emit.
// The variant Record, the bit of the kind, recorded traces, their text, tables of rows and the
// fingerprint follow from these. Request bits, from 28 on, fill optional fields (reachable, levels)
// of other records; the work is done once for all sinks.

namespace rovernet {

/// List of types of records.
template <class... R>
struct RecordList {};

/// Kinds of records, in the order of their bits and of the alternatives of Record. The bits are
/// fixed forever, because fingerprints and recorded traces contain them: append, never renumber.
using RecordKinds =
    RecordList<struct Sent, struct Transmitted, struct Received, struct Dropped, struct Moved,
               struct Arrived, struct NoWay, struct Switched, struct LinkUp, struct LinkDown,
               struct AirSent, struct ControlReceived, struct Routed>;

/// Set of kinds of records and of requests.
using KindMask = std::uint32_t;

/// Bit of type `T` in a list of types of records.
template <class T, class... R>
consteval KindMask bit_in(RecordList<R...>) {
    static_assert((std::is_same_v<T, R> || ...), "T is no kind of record");
    static_assert(sizeof...(R) < 28, "the bits from 28 on are requests");
    KindMask bit = 1;
    static_cast<void>(((std::is_same_v<T, R> || (bit <<= 1) == 0) || ...));
    return bit;
}

/// Kind of the records of type `T`: a mask with one bit, whose number is the index in RecordKinds.
///
///   if (sink.kinds() & kind_of<Moved>()) ...
template <class T>
consteval KindMask kind_of() {
    return bit_in<T>(RecordKinds{});
}

/// Kinds LinkUp and LinkDown. These records need a search for link changes, which runs only if a
/// sink wants them.
inline constexpr KindMask kind_links = kind_of<LinkUp>() | kind_of<LinkDown>();
/// Kinds of records that are in no fingerprint, because they follow from other records or depend on
/// the sinks. Fingerprints contain all other kinds, without the fields marked not_hashed.
inline constexpr KindMask kind_unhashed = kind_links | kind_of<Arrived>() | kind_of<NoWay>() |
                                          kind_of<Switched>() | kind_of<AirSent>() |
                                          kind_of<ControlReceived>() | kind_of<Routed>();

/// Request of a sink: fill Sent::reachable, by a search of the network for each message.
inline constexpr KindMask kind_reachable = 1U << 31;
/// Request of a sink: fill Sent::reachable while the searches are cheap compared with the
/// transmissions (Reachability::cheap_searches). Later Sent::reachable stays empty for the rest of
/// the run.
inline constexpr KindMask kind_cheap_reachable = 1U << 30;
/// Request of a sink: fill Received::levels, by computing the level at each receiver of each frame.
/// A routing protocol requests levels by its trait wants_levels.
inline constexpr KindMask kind_levels = 1U << 29;
/// Request of a sink: fill Sent::shortest, by a search of the network for each unicast.
inline constexpr KindMask kind_shortest = 1U << 28;
/// Mask of all kinds of records: bits 0 to 27 are set, and bits 28 to 31, the requests, are not.
inline constexpr KindMask kind_all = 0x0fffffff;

}  // namespace rovernet
