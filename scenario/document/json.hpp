// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

// Values as JSON: the output of --json, the files of a run's folder, the cells of a study's store.

namespace rovernet {

/// JSON document of a value: keys in their order, numbers in the fewest digits that read back the
/// same, two blanks of indentation, a newline at the end. NaN and infinity become null, and so does
/// an empty Value; bytes that are not UTF-8 become U+FFFD. Equal results give equal bytes.
std::string to_json(const Value& value);

/// JSON of a value in one line, without a newline.
std::string to_json_line(const Value& value);

/// Writer of a JSON object key by key, with the bytes of to_json(): for objects that are too large
/// for one Value.
class JsonObjectWriter {
  public:
    using Write = std::function<void(std::string_view)>;
    /// Appends the i-th item of a list; its lines after the first are indented by 4 blanks.
    using AppendItem = std::function<void(std::size_t i, std::string& out)>;

    /// @param write  receives the next piece of the text
    explicit JsonObjectWriter(Write write) : write_(std::move(write)) {}

    void set(std::string_view key, const Value& value);
    /// Writes a list of `size` items, one by one.
    void set_list(std::string_view key, std::size_t size, const AppendItem& append);
    /// Ends the object. Must be called once.
    void end() { write_(is_empty_ ? "{}\n" : "\n}\n"); }

  private:
    // Begins the entry with this key.
    void begin(std::string_view key);

    Write write_;
    bool is_empty_ = true;
};

/// Parses a JSON document; null becomes an empty Value, and no Value has a file position. Used for
/// JSON that rovernet wrote itself: a study's store, the measurement of a worker.
/// @throws InputError without a file position, if the text is not JSON or nests over 100 levels
Value parse_json(std::string_view text);

}  // namespace rovernet
