// SPDX-License-Identifier: MIT
#include "traces/row_sink.hpp"

#include "sim/error.hpp"
#include "sim/legs.hpp"
#include "traces/record_rows.hpp"
#include "traces/record_walk.hpp"

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace rovernet {
namespace {

std::int64_t ns(Duration d) { return d.count(); }
std::int64_t ns(Time t) { return t == never ? -1 : t.time_since_epoch().count(); }

CodeCell code(std::string_view letters) {
    CodeCell cell{};
    std::copy_n(letters.begin(), std::min(letters.size(), cell.size()), cell.begin());
    return cell;
}

template <class T>
constexpr std::string_view format_of() {
    if constexpr (std::is_same_v<T, std::int64_t>) return "<i8";
    if constexpr (std::is_same_v<T, std::int32_t>) return "<i4";
    if constexpr (std::is_same_v<T, double>) return "<f8";
    if constexpr (std::is_same_v<T, bool>) return "?";
    if constexpr (std::is_same_v<T, CodeCell>) return "<U4";
}

/// Cells of a record, in order: calls out.put(name, suffix, f) for each, where f() is its value.
template <class Out>
class Cells {
  public:
    /// @param reception  index among the receptions of the record
    Cells(Out& out, const RecordContext& context, Time time, std::size_t reception)
        : out_(out), context_(context), time_(time), reception_(reception) {}

    template <DescribedPart Part>
    void put_all(const Part& part) {
        for_each_field_of<Part>([&]<class Field>(const Field& f) {
            if constexpr ((Field::use & not_in_rows) == 0) {
                if (is_time_of_record(f)) return out_.put("t", "_ns", [&] { return ns(time_); });
                put(f.name, part.*f.member);
            }
        });
    }

  private:
    template <DescribedPart Part>
    void put(std::string_view, const Part& part) {
        put_all(part);
    }
    void put(std::string_view, const Leg& leg) {
        const Vec3 at = leg.position(time_), v = leg.velocity;
        put("start", leg.start), put("end", leg.end);
        put("x", at.x), put("y", at.y), put("z", at.z), put("vx", v.x), put("vy", v.y);
        put("vz", v.z), put("heading", leg.heading_at(time_)), put("turning", leg.turning);
    }
    void put(std::string_view, std::span<const Reception> receptions) {
        static const Reception none{};
        put_all(receptions.empty() ? none : receptions[reception_]);
    }
    void put(std::string_view, std::span<const Dbm> levels) {
        constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
        put("level", levels.empty() ? not_known : levels[reception_].value);
    }
    template <std::integral T>
    void put(std::string_view name, T value) {
        using Cell = std::conditional_t<(sizeof(T) < 8), std::int32_t, std::int64_t>;
        out_.put(name, "", [&] { return static_cast<Cell>(value); });
    }
    void put(std::string_view name, bool value) {
        out_.put(name, "", [&] { return value; });
    }
    void put(std::string_view name, double value) {
        out_.put(name, "", [&] { return value; });
    }
    template <Quantitative T>
    void put(std::string_view name, T quantity) {
        put(name, quantity.value);
    }
    void put(std::string_view name, Vec3 v) {
        out_.put(name, "_x", [&] { return v.x; });
        out_.put(name, "_y", [&] { return v.y; });
        out_.put(name, "_z", [&] { return v.z; });
    }
    void put(std::string_view name, Time time) {
        out_.put(name, "_ns", [&] { return ns(time); });
    }
    void put(std::string_view name, Duration time) {
        out_.put(name, "_ns", [&] { return ns(time); });
    }
    /// A robot is its number; -1 for `everyone` and none.
    void put(std::string_view name, NodeId robot) {
        put(name == "node" ? "robot" : name, robot.value);
    }
    void put(std::string_view name, const std::optional<NodeId>& robot) {
        put(name, robot.value_or(everyone));
    }
    template <class T>
    void put(std::string_view name, const std::optional<T>& value) {
        if constexpr (std::integral<T>) {
            put(name, value ? static_cast<std::int64_t>(*value) : -1);
        } else {
            put(name, value ? *number_in(*value) : std::numeric_limits<double>::quiet_NaN());
        }
    }
    void put(std::string_view, MessageId id) {
        const auto message = [&]() -> const Message& { return context_.messages[id]; };
        out_.put("uid", "", [&] { return static_cast<std::int64_t>(message().uid); });
        const auto put_number = [&](std::string_view name, auto get) {
            out_.put(name, "", [&] { return static_cast<std::int32_t>(get(message())); });
        };
        put_number("origin", [](const Message& m) { return m.origin.value; });
        put_number("to", [](const Message& m) { return m.to.value; });
        put_number("size", [](const Message& m) { return m.size; });
        put_number("flow", [](const Message& m) { return m.flow; });
    }
    template <class Reason>
    requires requires(Reason reason) { reason_of(reason); }
    void put(std::string_view, Reason reason) {
        out_.put("reason", "", [&] { return code(reason_of(reason).code); });
    }
    void put(std::string_view name, const ControlFrame* control) {
        out_.put(name, "", [&] { return code(AirFrame{.control = control}.kind()); });
    }

    Out& out_;
    const RecordContext& context_;
    Time time_;
    std::size_t reception_;
};

/// Cell of a record, and its place in a row.
struct Cell {
    std::string name;
    std::string_view format;
    std::size_t size, alignment;
    std::optional<std::size_t> place = {};  ///< [bytes]; empty: the row does not have it
};

/// Layout of the rows of a kind of records.
struct RowLayout {
    std::vector<Cell> cells;  ///< all of a record, in order
    std::vector<RowColumn> columns;
    std::size_t row_size = 0;

    template <class Get>
    void put(std::string_view name, std::string_view suffix, Get) {
        using T = std::invoke_result_t<Get>;
        cells.push_back(
            {std::string(name) + std::string(suffix), format_of<T>(), sizeof(T), alignof(T)});
    }
    /// Sets the columns, as words of row_columns.
    void choose(const std::string& columns);
};

void RowLayout::choose(const std::string& words) {
    std::vector<Cell*> chosen;
    std::istringstream in(words);
    for (std::string word; in >> word;) {
        const std::size_t equals = word.find('=');
        const std::string wanted = word.substr(equals + 1);  // npos + 1 is 0
        const auto cell = std::find_if(cells.begin(), cells.end(),
                                       [&](const Cell& each) { return each.name == wanted; });
        if (cell == cells.end()) throw std::logic_error("a record has no field named " + wanted);
        chosen.push_back(&*cell);
        columns.push_back({word.substr(0, equals), cell->format, 0});
    }
    const std::size_t largest = alignof(std::int64_t);
    for (std::size_t alignment = largest; alignment > 0; alignment /= 2) {
        for (Cell* cell : chosen) {
            if (cell->alignment == alignment) {
                cell->place = std::exchange(row_size, row_size + cell->size);
            }
        }
    }
    row_size = (row_size + largest - 1) / largest * largest;
    for (std::size_t i = 0; i < chosen.size(); ++i) columns[i].offset = *chosen[i]->place;
}

template <class R>
RowLayout make_layout() {
    RowLayout layout;
    const Legs legs;
    const MessageTable messages;
    const RecordContext nothing{legs, messages};
    Cells(layout, nothing, start_of_run, 0).put_all(R{});
    std::string all;
    for (const Cell& cell : layout.cells) all += cell.name + ' ';
    layout.choose(row_columns<R>.empty() ? all : std::string(row_columns<R>));
    return layout;
}

template <class... R>
std::vector<RowLayout> make_layouts(RecordList<R...>) {
    return {make_layout<R>()...};
}

const RowLayout& layout_of_row(std::size_t kind) {
    static const std::vector<RowLayout> all = make_layouts(RecordKinds{});
    return all[kind];
}

/// Writer of the cells of one row.
struct RowWriter {
    std::byte* row;
    const Cell* cell;

    template <class Get>
    void put(std::string_view, std::string_view, Get get) {
        const auto& place = (cell++)->place;
        if (!place) return;
        const auto value = get();
        std::memcpy(row + *place, &value, sizeof value);
    }
};

/// Name of a kind in words: "link_up" for LinkUp.
std::string in_words(std::string_view name) {
    std::string words;
    for (const char c : name) {
        const bool is_large = c >= 'A' && c <= 'Z';
        if (is_large && !words.empty()) words += '_';
        words += static_cast<char>(is_large ? c - 'A' + 'a' : c);
    }
    return words;
}

template <class... R>
std::vector<std::string> names_of(RecordList<R...>) {
    return {in_words(R::name)...};
}

}  // namespace

std::vector<std::string> record_names() { return names_of(RecordKinds{}); }

KindMask record_named(std::string_view name) {
    const std::vector<std::string> names = record_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return KindMask{1} << (found - names.begin());
    std::string all;
    for (const std::string& each : names) all += (all.empty() ? "" : ", ") + each;
    const std::string near = did_you_mean(name, names);
    throw std::invalid_argument("there is no record \"" + std::string(name) +
                                "\"; expected one of " + all + (near.empty() ? "" : "; " + near));
}

void RowSink::on(const Record& record, const RecordContext& context) {
    const RowLayout& layout = layout_of_row(record.index());
    std::vector<std::byte>& rows = rows_[record.index()];
    const auto append = [&](const auto& each) {
        for_each_time(each, [&](Time time, std::size_t reception) {
            rows.resize(rows.size() + layout.row_size);
            RowWriter row{rows.data() + rows.size() - layout.row_size, layout.cells.data()};
            Cells(row, context, time, reception).put_all(each);
        });
    };
    std::visit(append, record);
}

RowSink::Table RowSink::table(KindMask kind) const {
    const auto place = static_cast<std::size_t>(std::countr_zero(kind));
    const RowLayout& layout = layout_of_row(place);
    return {layout.columns, rows_.at(place), layout.row_size};
}

void RowSink::clear() {
    for (auto& rows : rows_) rows.clear();
}

}  // namespace rovernet
