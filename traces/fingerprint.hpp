// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace rovernet {

/// Fingerprint of a run: a hash of its behaviour. Any difference in the behaviour changes the hash.
///
/// XXH64 (seed 0) of all records: for each record its kind (the bit number of kind_of, one byte)
/// and its integers in little endian:
///
/// | record      | bytes                                                                      |
/// |-------------|----------------------------------------------------------------------------|
/// | Sent        | time 8, node 4, uid 8, origin 4, size 4, ttl 2, robots 4                   |
/// | Transmitted | time 8, frame, heard from 4 (all ones: from nobody)                        |
/// | Received    | per reception, each with the kind: frame, node 4, time 8, fate 1, delivered 1 |
/// | Dropped     | time 8, node 4, frame, reason 1                                            |
/// | Moved       | time 8, node 4, start 8, end 8, from 3 x 8, to 3 x 8                       |
///
/// where a frame is: uid 8, sender 4, ttl 2, hops 2. Times in [ns], positions in micrometres [um]
/// rounded to nearest. Data that depends on the sinks (`reachable`), and the division of a
/// transmission's receptions into records, are not included.
///
/// The table follows from the fields of the records (sim/record.hpp), in their order: all kinds
/// except kind_unhashed, and all fields except the fields marked not_hashed. Other real numbers are
/// rounded as positions; an optional begins with a byte that is 1 if it has a value.
/// Example: examples/fingerprint.cpp.
class Fingerprint {
  public:
    Fingerprint();
    Fingerprint(Fingerprint&&) noexcept;
    Fingerprint& operator=(Fingerprint&&) noexcept;
    ~Fingerprint();

    KindMask kinds() const { return kind_all & ~kind_unhashed; }
    void on(const Record& record, const RecordContext& context);

    /// Fingerprint of the records so far.
    std::uint64_t value() const;
    /// Hash value() as 16 hexadecimal digits.
    std::string text() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rovernet
