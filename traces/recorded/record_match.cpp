// SPDX-License-Identifier: MIT
#include "traces/recorded/record_match.hpp"

#include "traces/record_walk.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <variant>

namespace rovernet {
namespace {

/// Compares two records of one kind, or two values inside.
class Matcher {
  public:
    Matcher(const RecordContext& of_a, const RecordContext& of_b, unsigned format)
        : of_a_(of_a), of_b_(of_b), format_(format) {}

    template <DescribedPart Part>
    bool match(const Part& a, const Part& b) {
        bool is_same = true;
        for_each_field_of<Part>([&]<class Field>(const Field& f) {
            if constexpr ((Field::use & not_recorded) == 0) {
                if (first_format(Field::use) > format_) return;
                is_same = is_same && match(a.*f.member, b.*f.member);
            }
        });
        return is_same;
    }

  private:
    template <class T>
    requires(!DescribedPart<T> && !Quantitative<T>) bool match(const T& a, const T& b) {
        return a == b;
    }
    /// Numbers match if all their bits are equal: 0 and -0 differ.
    bool match(double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    }
    template <Quantitative T>
    bool match(T a, T b) {
        return match(a.value, b.value);
    }
    bool match(const ControlFrame* a, const ControlFrame* b) {
        return number_of(a) == number_of(b);
    }
    bool match(Vec3 a, Vec3 b) { return match(a.x, b.x) && match(a.y, b.y) && match(a.z, b.z); }
    bool match(MessageId a, MessageId b) {
        return is_control_ || of_a_.messages[a].uid == of_b_.messages[b].uid;
    }
    bool match(const AirFrame& a, const AirFrame& b) {
        is_control_ = !has_message(a);
        return has_message(a) == has_message(b) && match<AirFrame>(a, b);
    }
    bool match(std::span<const Reception> a, std::span<const Reception> b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [&](const auto& p, const auto& q) { return match(p, q); });
    }

    const RecordContext& of_a_;
    const RecordContext& of_b_;
    unsigned format_;
    bool is_control_ = false;  // the frames of the records have no message
};

}  // namespace

bool are_same(const Record& a, const RecordContext& of_a, const Record& b,
              const RecordContext& of_b, unsigned format) {
    if (a.index() != b.index()) return false;
    return std::visit(
        [&](const auto& one) {
            const auto* other = std::get_if<std::decay_t<decltype(one)>>(&b);
            return other && Matcher(of_a, of_b, format).match(one, *other);
        },
        a);
}

}  // namespace rovernet
