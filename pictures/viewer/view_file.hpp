// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rovernet {

/// Number type of a column in a view file.
template <class T>
concept ColumnNumber = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, float> || std::same_as<T, double>;

/// Index in a view file that stands for everyone, or for no object.
inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// Writer of a view file, the file that the viewer's page reads: a head in JSON, and named columns
/// of numbers. Each column is compressed when it is added, by default. docs/formats/view-format.md
/// describes the bytes.
///
///   ViewFile file;
///   file.add("legs.x", std::span<const double>(x));
///   const std::string bytes = file.bytes(std::move(head));
class ViewFile {
  public:
    ViewFile() = default;
    /// @param packs  whether columns are compressed
    explicit ViewFile(bool packs) : packs_(packs) {}

    /// Adds a column of numbers.
    template <ColumnNumber T>
    void add(const std::string& name, std::span<const T> numbers) {
        add(name, type_of<T>(), numbers.size(),
            {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
    }
    template <ColumnNumber T>
    void add(const std::string& name, const std::vector<T>& numbers) {
        add(name, std::span<const T>(numbers));
    }
    /// Adds a column of indices below `size`, or no_index, as u16 if `size` is below 65,535, else
    /// as u32. The largest value of the type is no_index.
    void add_indices(const std::string& name, std::span<const std::uint32_t> indices,
                     std::size_t size);
    /// Adds a column of times [ns] since the start of the run, in ascending order, each at least 0.
    void add_times(const std::string& name, std::span<const std::int64_t> times);
    /// Adds a column of texts.
    void add_texts(const std::string& name, std::span<const std::string> texts);

    /// Bytes of the file with all columns. @param head  head without the key `sections`, which is
    /// added
    std::string bytes(Table head) const;

  private:
    template <class T>
    static constexpr std::string_view type_of() {
        if (std::is_same_v<T, std::uint8_t>) return "u8";
        if (std::is_same_v<T, std::uint16_t>) return "u16";
        if (std::is_same_v<T, std::uint32_t>) return "u32";
        return std::is_same_v<T, float> ? "f32" : "f64";
    }
    void add(const std::string& name, std::string_view type, std::size_t count,
             std::string_view bytes);

    bool packs_ = true;
    Array sections_;    // descriptions of the columns
    std::string data_;  // columns, compressed if packs_
};

/// View file that is being written, with its head so far.
struct ViewDraft {
    ViewFile file = {};
    Table head = {};

    std::string bytes() && { return file.bytes(std::move(head)); }
};

}  // namespace rovernet
