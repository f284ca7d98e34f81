// SPDX-License-Identifier: MIT
#pragma once

#include "sim/record.hpp"
#include "traces/record_rows.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

namespace rovernet {

/// Column of a table.
struct RowColumn {
    std::string_view name;
    std::string_view format;  ///< format of its cells in numpy's notation: "<i8", "<f8", "?", "<U4"
    std::size_t offset;       ///< offset of the column's cell in a row [bytes]
};

/// Sink that stores the records of some kinds as rows, for programs that analyse a complete run.
///
///   const auto rows = std::make_shared<RowSink>(kind_of<Received>());
///   network.add_sink(rows);
///   network.run_for(10s);
///   for (const ReceivedRow& row : rows->of<ReceivedRow>()) add(row.level);
class RowSink {
  public:
    /// Table of the records of one kind, valid until the next record.
    struct Table {
        std::span<const RowColumn> columns;
        std::span<const std::byte> bytes;
        std::size_t row_size;  ///< size of a row [bytes]
        std::size_t size() const { return bytes.size() / row_size; }
    };

    explicit RowSink(KindMask kinds) : kinds_(kinds) {}

    KindMask kinds() const {
        return kinds_ | ((kinds_ & kind_of<Received>()) != 0 ? kind_levels : 0);
    }
    void on(const Record& record, const RecordContext& context);

    /// Rows of the records of one kind, in the order of the run.
    template <class Row>
    const std::vector<Row>& of() const {
        return std::get<std::vector<Row>>(rows_);
    }
    /// Table of the kind whose bit is set in `kind`, one of the record kinds.
    Table table(KindMask kind) const;
    /// Removes all rows of all tables.
    void clear();

  private:
    // Tables in the order of the variant Record.
    using Rows =
        std::tuple<std::vector<SentRow>, std::vector<TransmittedRow>, std::vector<ReceivedRow>,
                   std::vector<DroppedRow>, std::vector<MovedRow>, std::vector<ArrivedRow>,
                   std::vector<NoWayRow>, std::vector<SwitchedRow>, std::vector<LinkUpRow>,
                   std::vector<LinkDownRow>, std::vector<AirSentRow>,
                   std::vector<ControlReceivedRow>>;
    static_assert(std::tuple_size_v<Rows> == std::variant_size_v<Record>);

    KindMask kinds_;
    Rows rows_;
};

/// Names of the kinds of records, in the order of their bits: "sent", "link_up".
extern const std::array<std::string_view, std::variant_size_v<Record>> record_names;
/// Bit of the kind with that name. @throws std::invalid_argument with the list of valid names
KindMask record_named(std::string_view name);

}  // namespace rovernet
