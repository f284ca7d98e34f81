// SPDX-License-Identifier: MIT
#include "traces/recorded/record_text.hpp"

#include "traces/record_walk.hpp"
#include "traces/recorded/record_code.hpp"

#include <fmt/format.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

namespace rovernet {
namespace {

constexpr std::array<std::string_view, 8> fate_words = {
    "waiting", "ttl", "duplicate", "off", "garbled", "collided", "busy", "arrived"};
static_assert(fate_words.size() == static_cast<std::size_t>(last_fate) + 1);

/// Fields of records as words with a blank before each.
class TextWriter {
  public:
    TextWriter(const RecordContext& context, std::string& text) : context_(context), text_(text) {}

    template <class R>
    void operator()(const R& r) {
        for_each_time(r, [&](Time time, std::size_t reception) {
            reception_ = reception;
            fmt::format_to(std::back_inserter(text_), "{} {}", time.time_since_epoch().count(),
                           R::name);
            put(r);
            text_ += '\n';
        });
    }

  private:
    template <DescribedPart Part>
    void put(const Part& part) {
        for_each_recorded<Part>([&](const auto& f) { put(part.*f.member); });
    }
    template <class Word>
    requires(std::is_arithmetic_v<Word> ||
             std::same_as<Word, std::string_view>) void put(const Word& word) {
        fmt::format_to(std::back_inserter(text_), " {}", word);
    }
    void put(bool value) { put(value ? 1 : 0); }
    void put_nothing() { put(std::string_view("-")); }
    template <class Enum>
    requires std::is_enum_v<Enum>
    void put(Enum value) { put(static_cast<unsigned>(value)); }
    template <Quantitative T>
    void put(T quantity) {
        put(quantity.value);
    }
    template <class T>
    void put(const std::optional<T>& value) {
        if (value) return put(*value);
        put_nothing();
    }
    void put(Duration duration) { put(duration.count()); }
    void put(const ControlFrame* control) { put(unsigned{number_of(control)}); }
    void put(Time time) {
        if (time == never) return put_nothing();
        put(time.time_since_epoch());
    }
    void put(NodeId node) {
        if (node == everyone) return put_nothing();
        put(node.value);
    }
    void put(MessageId id) {
        if (is_control_) return put_nothing();
        put(context_.messages[id].uid);
    }
    void put(Vec3 v) { put(v.x), put(v.y), put(v.z); }
    void put(const AirFrame& air) {
        is_control_ = !has_message(air);
        put<AirFrame>(air);
    }
    void put(std::span<const Reception> receptions) { put(receptions[reception_]); }
    void put(const Reception& rx) {
        put(rx.node);
        put(fate_words[static_cast<std::size_t>(rx.fate)]);
        if (rx.delivered) text_ += '+';
    }

    const RecordContext& context_;
    std::string& text_;
    std::size_t reception_ = 0;  // of the line
    bool is_control_ = false;    // the frame of the record has no message
};

}  // namespace

void append_text(const Record& record, const RecordContext& context, std::string& text) {
    std::visit(TextWriter(context, text), record);
}

}  // namespace rovernet
