// SPDX-License-Identifier: MIT
#include "traces/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#define XXH_STATIC_LINKING_ONLY  // the state as a value
#include <xxhash.h>

namespace rovernet {
namespace {

/// Micrometres [um] nearest to x [m]; beyond 9.2e12 m (or for NaN) the nearest end of the range.
std::int64_t micrometres(double x) {
    constexpr double limit = 9.2e18;
    const double um = std::round(x * 1e6);
    if (um < limit && um > -limit) return static_cast<std::int64_t>(um);
    return um < 0 ? std::numeric_limits<std::int64_t>::min()
                  : std::numeric_limits<std::int64_t>::max();
}

/// Appends integers to a buffer, little endian. The buffer must have enough space.
class Packed {
  public:
    explicit Packed(std::uint8_t* at) : at_(at) {}

    template <class Integer>
    Packed& put(Integer value) {
        if constexpr (std::endian::native == std::endian::little) {
            std::memcpy(at_, &value, sizeof value);
        } else {
            auto rest = static_cast<std::uint64_t>(value);
            for (std::size_t i = 0; i < sizeof value; ++i, rest >>= 8) {
                at_[i] = static_cast<std::uint8_t>(rest);
            }
        }
        at_ += sizeof value;
        return *this;
    }
    Packed& put(Time t) { return put(std::int64_t{t.time_since_epoch().count()}); }
    Packed& put(NodeId node) { return put(node.value); }
    Packed& put(Vec3 p) {
        return put(micrometres(p.x)).put(micrometres(p.y)).put(micrometres(p.z));
    }
    template <std::size_t size>
    Packed& put(const std::array<std::uint8_t, size>& bytes) {
        std::memcpy(at_, bytes.data(), size);
        at_ += size;
        return *this;
    }
    Packed& put(const Frame& frame, const RecordContext& context) {
        return put(context.messages[frame.message].uid)
            .put(frame.sender)
            .put(frame.ttl)
            .put(frame.hops);
    }
    std::uint8_t* end() const { return at_; }

  private:
    std::uint8_t* at_;
};

}  // namespace

/// Hash state. The last few bytes wait in a buffer and are hashed together; the result is the same
/// as byte by byte.
struct Fingerprint::State {
    static constexpr std::size_t longest = 80;  // record [bytes]

    State() { XXH64_reset(&hash, 0); }
    static std::uint8_t number(KindMask kind) {
        return static_cast<std::uint8_t>(std::countr_zero(kind));
    }
    /// Whether `bytes` has no space for one more record.
    bool is_full(const Packed& bytes) const {
        return bytes.end() > waiting.data() + waiting.size() - longest;
    }
    /// Space for one more record, after those that wait.
    Packed room() {
        const Packed bytes(waiting.data() + used);
        if (!is_full(bytes)) return bytes;
        XXH64_update(&hash, waiting.data(), used);
        used = 0;
        return Packed(waiting.data());
    }
    Packed record(KindMask kind) { return room().put(number(kind)); }
    void add(const Packed& bytes) { used = static_cast<std::size_t>(bytes.end() - waiting.data()); }
    std::uint64_t value() const {
        XXH64_state_t all = hash;
        XXH64_update(&all, waiting.data(), used);
        return XXH64_digest(&all);
    }

    void on(const Sent& r, const RecordContext& context) {
        const Message& m = context.messages[r.message];
        add(record(kind_of<Sent>())
                .put(r.time)
                .put(r.node)
                .put(m.uid)
                .put(m.origin)
                .put(m.size)
                .put(r.ttl)
                .put(r.robots));
    }
    void on(const Transmitted& r, const RecordContext& context) {
        add(record(kind_of<Transmitted>())
                .put(r.time)
                .put(r.frame, context)
                .put(r.heard_from.value_or(everyone)));
    }
    void on(const Received& r, const RecordContext& context) {
        // The bytes of every reception begin with kind and frame: packed once, then copied.
        std::array<std::uint8_t, 17> begin;
        Packed(begin.data()).put(number(kind_of<Received>())).put(r.frame, context);
        Packed bytes = room();
        for (const Reception& rx : r.receptions) {
            if (is_full(bytes)) {
                add(bytes);
                bytes = room();
            }
            bytes.put(begin)
                .put(rx.node)
                .put(rx.time)
                .put(static_cast<std::uint8_t>(rx.fate))
                .put(static_cast<std::uint8_t>(rx.delivered));
        }
        add(bytes);
    }
    void on(const Dropped& r, const RecordContext& context) {
        add(record(kind_of<Dropped>())
                .put(r.time)
                .put(r.node)
                .put(r.frame, context)
                .put(static_cast<std::uint8_t>(r.reason)));
    }
    void on(const Moved& r, const RecordContext&) {
        add(record(kind_of<Moved>())
                .put(r.time)
                .put(r.node)
                .put(r.leg.start)
                .put(r.leg.end)
                .put(r.leg.from)
                .put(r.leg.to));
    }
    template <class Other>
    void on(const Other&, const RecordContext&) {}

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
