// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Code of up to four letters, such as a loss reason, padded with zeros.
using CodeCell = std::array<char32_t, 4>;

/// Column of a table of records.
struct RowColumn {
    std::string name;
    std::string_view format;  ///< format of the cells in numpy's notation: "<i8", "<f8", "?", "<U4"
    std::size_t offset;       ///< offset of the column's cell in a row [bytes]
};

/// Sink that stores the records of some kinds as rows of numbers and codes, for programs that
/// analyse a complete run. traces/record_rows.hpp has the columns.
///
///   const auto rows = std::make_shared<RowSink>(kind_of<Received>());
///   network.add_sink(rows);
///   network.run_for(10s);
///   const RowSink::Table received = rows->table(kind_of<Received>());
class RowSink {
  public:
    /// Table of the records of one kind, valid until the next record.
    struct Table {
        std::span<const RowColumn> columns;
        std::span<const std::byte> bytes;
        std::size_t row_size;  ///< size of a row in `bytes` [bytes]
        std::size_t size() const { return bytes.size() / row_size; }
    };

    explicit RowSink(KindMask kinds) : kinds_(kinds) {}

    KindMask kinds() const {
        return kinds_ | ((kinds_ & kind_of<Received>()) != 0 ? kind_levels : 0);
    }
    void on(const Record& record, const RecordContext& context);

    /// Table of the records of one kind. @param kind  bit of a stored kind
    Table table(KindMask kind) const;
    /// Removes all rows of all tables.
    void clear();

  private:
    KindMask kinds_;
    std::array<std::vector<std::byte>, std::variant_size_v<Record>> rows_;  // rows by kind's bit
};

/// Names of the kinds of records, in the order of their bits: "sent", "link_up".
std::vector<std::string> record_names();
/// Bit of the record kind with this name. @throws std::invalid_argument with a list of valid names
KindMask record_named(std::string_view name);

}  // namespace rovernet
