// SPDX-License-Identifier: MIT
#include "traces/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#define XXH_INLINE_ALL
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

/// The bytes of one record, little endian.
class Bytes {
  public:
    explicit Bytes(KindMask kind) { put(static_cast<std::uint8_t>(std::countr_zero(kind))); }

    template <class Integer>
    Bytes& put(Integer value) {
        auto rest = static_cast<std::uint64_t>(value);
        for (std::size_t i = 0; i < sizeof(Integer); ++i, rest >>= 8) {
            bytes_[size_++] = static_cast<std::uint8_t>(rest);
        }
        return *this;
    }
    Bytes& put(Time t) { return put(t.time_since_epoch().count()); }
    Bytes& put(NodeId node) { return put(node.value); }
    Bytes& put(Vec3 p) { return put(micrometres(p.x)).put(micrometres(p.y)).put(micrometres(p.z)); }
    Bytes& put(const Frame& frame, const RecordContext& context) {
        return put(context.messages[frame.message].uid)
            .put(frame.sender)
            .put(frame.ttl)
            .put(frame.hops);
    }
    void hash_into(XXH64_state_t& state) const { XXH64_update(&state, bytes_.data(), size_); }

  private:
    std::array<std::uint8_t, 80> bytes_;
    std::size_t size_ = 0;
};

}  // namespace

struct Fingerprint::State {
    State() { XXH64_reset(&hash, 0); }
    void add(const Bytes& bytes) { bytes.hash_into(hash); }

    void on(const Sent& r, const RecordContext& context) {
        const Message& m = context.messages[r.message];
        add(Bytes(kind_of<Sent>())
                .put(r.time)
                .put(r.node)
                .put(m.uid)
                .put(m.origin)
                .put(m.size)
                .put(r.ttl)
                .put(r.robots));
    }
    void on(const Transmitted& r, const RecordContext& context) {
        add(Bytes(kind_of<Transmitted>())
                .put(r.time)
                .put(r.frame, context)
                .put(r.heard_from.value_or(everyone)));
    }
    void on(const Received& r, const RecordContext& context) {
        const Bytes start = Bytes(kind_of<Received>()).put(r.frame, context);
        for (const Reception& rx : r.receptions) {
            Bytes bytes = start;
            add(bytes.put(rx.node)
                    .put(rx.time)
                    .put(static_cast<std::uint8_t>(rx.fate))
                    .put(static_cast<std::uint8_t>(rx.delivered)));
        }
    }
    void on(const Dropped& r, const RecordContext& context) {
        add(Bytes(kind_of<Dropped>())
                .put(r.time)
                .put(r.node)
                .put(r.frame, context)
                .put(static_cast<std::uint8_t>(r.reason)));
    }
    void on(const Moved& r, const RecordContext&) {
        add(Bytes(kind_of<Moved>())
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
};

Fingerprint::Fingerprint() : state_(std::make_unique<State>()) {}
Fingerprint::Fingerprint(Fingerprint&&) noexcept = default;
Fingerprint& Fingerprint::operator=(Fingerprint&&) noexcept = default;
Fingerprint::~Fingerprint() = default;

void Fingerprint::on(const Record& record, const RecordContext& context) {
    std::visit([&](const auto& r) { state_->on(r, context); }, record);
}

std::uint64_t Fingerprint::value() const { return XXH64_digest(&state_->hash); }

std::string Fingerprint::text() const { return fmt::format("{:016x}", value()); }

}  // namespace rovernet
