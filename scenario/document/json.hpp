// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

// Conversion between Values and JSON. JSON is the output of --json, the format of files in a run's
// folder, and the content of cells in a study's store.

namespace rovernet {

/// JSON document of a value: keys in their order, two blanks of indentation, a newline at the end.
/// A number has the fewest digits that read back as the same number. NaN, infinity and an empty
/// Value become null. Bytes that are not UTF-8 become U+FFFD. Equal values give equal bytes.
std::string to_json(const Value& value);

/// JSON of a value in one line, without a newline.
std::string to_json_line(const Value& value);

/// Writer of a JSON object key by key, with the bytes of to_json(): for objects that are too large
/// for one Value.
class JsonObjectWriter {
  public:
    using Write = std::function<void(std::string_view)>;
    /// Function that appends the JSON text of the i-th item of a list to `out`, i from 0. Lines of
    /// the item after its first line are indented by 4 blanks.
    using AppendItem = std::function<void(std::size_t i, std::string& out)>;

    /// @param write  function that receives the JSON text piece by piece
    explicit JsonObjectWriter(Write write) : write_(std::move(write)) {}

    void set(std::string_view key, const Value& value);
    /// Writes a list of `size` items, one by one.
    void set_list(std::string_view key, std::size_t size, const AppendItem& append);
    /// Writes the end of the JSON object. Must be called once, after the last entry.
    void end() { write_(is_empty_ ? "{}\n" : "\n}\n"); }

  private:
    // Writes the beginning of an entry: the separator, the key and a colon.
    void begin(std::string_view key);

    Write write_;
    bool is_empty_ = true;
};

/// Parses a JSON document; null becomes an empty Value, and no Value has a file position. Used for
/// JSON that rovernet wrote itself: a study's store, the measurement of a worker.
/// @throws InputError without a file position, if the text is not JSON or nests over 100 levels
Value parse_json(std::string_view text);

}  // namespace rovernet
