// SPDX-License-Identifier: MIT
#include "traces/fingerprint.hpp"

#include "traces/record_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#define XXH_STATIC_LINKING_ONLY  // the state as a value
#include <xxhash.h>

namespace rovernet {
namespace {

/// Millionths nearest to x; beyond 9.2e12 (or for NaN) the nearest end of the range.
std::int64_t millionths(double x) {
    constexpr double limit = 9.2e18;
    const double scaled = std::round(x * 1e6);
    if (scaled < limit && scaled > -limit) return static_cast<std::int64_t>(scaled);
    return scaled < 0 ? std::numeric_limits<std::int64_t>::min()
                      : std::numeric_limits<std::int64_t>::max();
}

/// Appends integers to a buffer, little endian. The buffer must have enough space.
class Packed {
  public:
    explicit Packed(std::uint8_t* at) : at_(at) {}

    template <std::integral Integer>
    void put(Integer value) {
        if constexpr (std::endian::native == std::endian::little) {
            std::memcpy(at_, &value, sizeof value);
        } else {
            auto rest = static_cast<std::uint64_t>(value);
            for (std::size_t i = 0; i < sizeof value; ++i, rest >>= 8) {
                at_[i] = static_cast<std::uint8_t>(rest);
            }
        }
        at_ += sizeof value;
    }
    void copy(const std::uint8_t* bytes, std::size_t size) {
        std::memcpy(at_, bytes, size);
        at_ += size;
    }
    std::uint8_t* end() const { return at_; }

  private:
    std::uint8_t* at_;
};

/// Appends fields of records to a buffer, as fingerprint.hpp lists their bytes.
class PackedFields {
  public:
    PackedFields(Packed& to, const RecordContext& context) : to_(to), context_(context) {}

    template <DescribedPart Part>
    void put(const Part& part) {
        for_each_field_of<Part>([&]<class Field>(const Field& f) {
            if constexpr ((Field::use & not_hashed) == 0) put(part.*f.member);
            if constexpr ((Field::use & with_origin) != 0) {
                const Message& message = context_.messages[part.*f.member];
                put(message.origin), put(message.size);
            }
        });
    }

  private:
    template <std::integral T>
    void put(T value) {
        to_.put(value);
    }
    void put(bool value) { put(static_cast<std::uint8_t>(value)); }
    template <class Enum>
    requires std::is_enum_v<Enum>
    void put(Enum value) { put(static_cast<std::uint8_t>(value)); }
    void put(Duration duration) { put(std::int64_t{duration.count()}); }
    void put(Time time) { put(time.time_since_epoch()); }
    void put(NodeId node) { put(node.value); }
    void put(MessageId message) { put(context_.messages[message].uid); }
    void put(double value) { put(millionths(value)); }
    template <Quantitative T>
    void put(T quantity) {
        put(quantity.value);
    }
    void put(Vec3 v) { put(v.x), put(v.y), put(v.z); }
    void put(std::optional<NodeId> node) { put(node.value_or(everyone)); }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        put(value.value_or(T{}));
    }

    Packed& to_;
    const RecordContext& context_;
};

}  // namespace

/// Hash state. The last few bytes wait in a buffer and are hashed together; the result is the same
/// as byte by byte.
struct Fingerprint::State {
    State() { XXH64_reset(&hash, 0); }
    template <class R>
    static constexpr auto number = static_cast<std::uint8_t>(std::countr_zero(kind_of<R>()));
    /// Upper bound of the bytes of a field, its kind included: a slot of 4 bytes has 16 at most.
    template <class T>
    static constexpr std::size_t longest = 1 + 4 * sizeof(T);
    /// Whether `bytes` has no space for `size` more.
    bool is_full(const Packed& bytes, std::size_t size) const {
        return bytes.end() > waiting.data() + waiting.size() - size;
    }
    /// Space for `size` bytes, after those that wait.
    Packed room(std::size_t size) {
        const Packed bytes(waiting.data() + used);
        if (!is_full(bytes, size)) return bytes;
        XXH64_update(&hash, waiting.data(), used);
        used = 0;
        return Packed(waiting.data());
    }
    void add(const Packed& bytes) { used = static_cast<std::size_t>(bytes.end() - waiting.data()); }
    std::uint64_t value() const {
        XXH64_state_t all = hash;
        XXH64_update(&all, waiting.data(), used);
        return XXH64_digest(&all);
    }

    template <class R>
    void on(const R& r, const RecordContext& context) {
        if constexpr ((kind_of<R>() & kind_unhashed) == 0) {
            Packed bytes = room(longest<R>);
            bytes.put(number<R>);
            PackedFields(bytes, context).put(r);
            add(bytes);
        }
    }
    void on(const Received& r, const RecordContext& context) {
        // The bytes of every reception begin with kind and frame: packed once, then copied.
        std::array<std::uint8_t, longest<Frame>> begin;
        Packed head(begin.data());
        head.put(number<Received>);
        PackedFields(head, context).put(r.frame);
        const auto head_size = static_cast<std::size_t>(head.end() - begin.data());
        constexpr std::size_t size = begin.size() + longest<Reception>;
        Packed bytes = room(size);
        for (const Reception& rx : r.receptions) {
            if (is_full(bytes, size)) {
                add(bytes);
                bytes = room(size);
            }
            bytes.copy(begin.data(), head_size);
            PackedFields(bytes, context).put(rx);
        }
        add(bytes);
    }

    XXH64_state_t hash;
    std::array<std::uint8_t, 8192> waiting;
    std::size_t used = 0;
};

Fingerprint::Fingerprint() : state_(std::make_unique<State>()) {}
Fingerprint::Fingerprint(Fingerprint&&) noexcept = default;
Fingerprint& Fingerprint::operator=(Fingerprint&&) noexcept = default;
Fingerprint::~Fingerprint() = default;

void Fingerprint::on(const Record& record, const RecordContext& context) {
    std::visit([&](const auto& r) { state_->on(r, context); }, record);
}

std::uint64_t Fingerprint::value() const { return state_->value(); }

std::string Fingerprint::text() const { return fmt::format("{:016x}", value()); }

}  // namespace rovernet
