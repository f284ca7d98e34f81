// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_text.hpp"

#include "traces/ns2/decimal.hpp"
#include "traces/ns2/ns2_words.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace rovernet {
namespace {

void add_seconds(std::string& out, Time time) {
    std::array<char, longest_decimal> text;
    out.append(text.data(), write_seconds(text.data(), time));
}

template <class... Values>
void add(std::string& out, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Values>(values)...);
}

/// Numbers in a payload that both formats have.
struct KnownPayload {
    enum class Kind { none, cbr, tcp, other } kind = Kind::other;
    std::int64_t seq = 0, ack = 0, forwards = 0, optimum = 0;
};

bool read_old_numbers(std::string_view text, KnownPayload& payload) {
    Ns2Words words(text);
    std::string_view first = words.next();
    const bool is_cbr = first.ends_with(']');
    payload.kind = is_cbr ? KnownPayload::Kind::cbr : KnownPayload::Kind::tcp;
    if (!words.strip(first, "[", is_cbr ? "]" : "", "") || !words.integer(first, payload.seq, "")) {
        return false;
    }
    if (!is_cbr) {
        std::string_view ack = words.next();
        if (!words.strip(ack, "", "]", "") || !words.integer(ack, payload.ack, "")) return false;
    }
    return words.integer(words.next(), payload.forwards, "") &&
           words.integer(words.next(), payload.optimum, "") && words.next().empty();
}

bool read_new_numbers(std::string_view text, KnownPayload& payload) {
    Ns2Words words(text);
    const auto number = [&](std::string_view key, std::int64_t& value) {
        return words.expect(key) && words.integer(words.next(), value, "");
    };
    if (!words.expect("-Pn")) return false;
    const std::string_view name = words.next();
    const bool is_cbr = name == "cbr";
    payload.kind = is_cbr ? KnownPayload::Kind::cbr : KnownPayload::Kind::tcp;
    return (is_cbr ? number("-Pi", payload.seq)
                   : name == "tcp" && number("-Ps", payload.seq) && number("-Pa", payload.ack)) &&
           number("-Pf", payload.forwards) && number("-Po", payload.optimum) &&
           words.next().empty();
}

bool read_tagged_numbers(std::string_view text, KnownPayload& payload) {
    Ns2Words words(text);
    const auto number = [&](std::string_view key, std::int64_t& value) {
        return words.expect(key) && words.integer(words.next(), value, "");
    };
    payload.kind = KnownPayload::Kind::cbr;
    return number("-cbr:s", payload.seq) && number("-cbr:f", payload.forwards) &&
           number("-cbr:o", payload.optimum) && words.next().empty();
}

KnownPayload payload_of(const Ns2Packet& packet) {
    KnownPayload payload;
    payload.kind = KnownPayload::Kind::none;
    if (packet.payload.empty()) return payload;
    const bool is_known =
        packet.dialect == Ns2Dialect::old_format   ? read_old_numbers(packet.payload, payload)
        : packet.dialect == Ns2Dialect::new_format ? read_new_numbers(packet.payload, payload)
                                                   : read_tagged_numbers(packet.payload, payload);
    if (!is_known) payload.kind = KnownPayload::Kind::other;
    return payload;
}

constexpr std::string_view no_network_part =
    "ARP, RTS, CTS, ACK and other frames of the MAC layer: only one of the two formats contains "
    "their type and size";
constexpr std::string_view other_payload =
    "packets of routing agents and of other types: only packets of TCP and of constant bit rate "
    "(CBR) have contents that can be converted";

/// Ethertype of a packet; that of IP if S-MAC gives none, because a reader recognises by it that a
/// MAC has sent the packet.
std::uint32_t ethertype_of(const Ns2Mac& mac) {
    constexpr std::uint32_t ip = 0x800;
    return mac.ethertype == 0 && mac.has_sent() ? ip : mac.ethertype;
}

}  // namespace

std::string_view write_old_line(const Ns2Packet& p, std::string& out) {
    if (!p.ip || !p.size || !p.mac) return no_network_part;
    const KnownPayload payload = payload_of(p);
    if (payload.kind == KnownPayload::Kind::other) return other_payload;
    add(out, "{} ", p.op);
    add_seconds(out, p.time);
    add(out, " _{}_ {:>3} {:>4} {} {} {} [{:x} {:x} {:x} {:x}] ", p.node.value, p.layer, p.reason,
        p.uid, p.type, *p.size, p.mac->duration_us, p.mac->to, p.mac->from, ethertype_of(*p.mac));
    add(out, "------- [{}:{} {}:{} {} {}] ", p.ip->from, p.ip->from_port, p.ip->to, p.ip->to_port,
        p.ip->ttl, p.ip->next_hop);
    if (payload.kind == KnownPayload::Kind::cbr) {
        add(out, "[{}] {} {}", payload.seq, payload.forwards, payload.optimum);
    } else if (payload.kind == KnownPayload::Kind::tcp) {
        add(out, "[{} {}] {} {}", payload.seq, payload.ack, payload.forwards, payload.optimum);
    }
    out += '\n';
    return "";
}

std::string_view write_new_line(const Ns2Packet& p, Vec3 place, std::string& out) {
    if (!p.ip || !p.size || !p.mac) return no_network_part;
    const KnownPayload payload = payload_of(p);
    if (payload.kind == KnownPayload::Kind::other) return other_payload;
    add(out, "{} -t ", p.op == 'D' ? 'd' : p.op);
    add_seconds(out, p.time);
    // -Hd, the next hop: -2 if none is set.
    add(out, " -Hs {} -Hd {} -Ni {}", p.node.value, p.ip->next_hop > 0 ? p.ip->next_hop : -2,
        p.node.value);
    add(out, " -Nx {:.2f} -Ny {:.2f} -Nz {:.2f} -Ne {:.6f} -Nl {} -Nw {}", place.x, place.y,
        place.z, p.energy.value_or(-1), p.layer, p.reason);
    add(out, " -Ma {:x} -Md {:x} -Ms {:x} -Mt {:x} ", p.mac->duration_us, p.mac->to, p.mac->from,
        ethertype_of(*p.mac));
    add(out, "-Is {}.{} -Id {}.{} -It {} -Il {} -If {} -Ii {} -Iv {} ", p.ip->from, p.ip->from_port,
        p.ip->to, p.ip->to_port, p.type, *p.size, p.flow, p.uid, p.ip->ttl);
    if (payload.kind == KnownPayload::Kind::cbr) {
        add(out, "-Pn cbr -Pi {} -Pf {} -Po {} ", payload.seq, payload.forwards, payload.optimum);
    } else if (payload.kind == KnownPayload::Kind::tcp) {
        add(out, "-Pn tcp -Ps {} -Pa {} -Pf {} -Po {} ", payload.seq, payload.ack, payload.forwards,
            payload.optimum);
    }
    out += '\n';
    return "";
}

const std::string_view ns2_csv_head =
    "event,time_s,robot,layer,reason,uid,type,size,mac_duration_us,mac_to,mac_from,ethertype,"
    "source,source_port,destination,destination_port,ttl,x_m,y_m,z_m,energy_j,goal_x_m,goal_y_m,"
    "speed_m_s,reachable";

namespace {

/// Appends a cell with any text.
void add_cell(std::string& out, std::string_view text) {
    if (text.find_first_of(",\"") == text.npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    out += '"';
}

void add_row(std::string& out, const Ns2Packet& p) {
    add(out, "{},", p.op);
    add_seconds(out, p.time);
    add(out, ",{},{},{},", p.node.value, p.layer, p.reason == "---" ? "" : p.reason);
    if (p.uid_column > 0) add(out, "{}", p.uid);
    out += ',';
    add_cell(out, p.type);
    out += ',';
    if (p.size) add(out, "{}", *p.size);
    if (p.mac) {
        add(out, ",{},{},{},{},", p.mac->duration_us, p.mac->to, p.mac->from, p.mac->ethertype);
    } else {
        out += ",,,,,";
    }
    if (p.ip) {
        add(out, "{},{},{},{},{},", p.ip->from, p.ip->from_port, p.ip->to, p.ip->to_port,
            p.ip->ttl);
    } else {
        out += ",,,,,";
    }
    if (p.position) {
        add(out, "{},{},{},", p.position->x, p.position->y, p.position->z);
    } else {
        out += ",,,";
    }
    if (p.energy) add(out, "{}", *p.energy);
    out += ",,,,";
}

void add_row(std::string& out, const Ns2Move& m) {
    out += "M,";
    add_seconds(out, m.time);
    add(out, ",{},,,,,,,,,,,,,,,{},{},{},,{},{},{},", m.node.value, m.from.x, m.from.y, m.from.z,
        m.to.x, m.to.y, m.speed);
}

void add_row(std::string& out, const Ns2Energy& e) {
    out += "N,";
    add_seconds(out, e.time);
    add(out, ",{},,,,,,,,,,,,,,,,,,{},,,,", e.node.value, e.energy);
}

void add_row(std::string& out, const Ns2Reachable& r) {
    out += "v,";
    add_seconds(out, r.time);
    add(out, ",,,,{},,,,,,,,,,,,,,,,,,,{}", r.uid, r.robots);
}

void add_row(std::string&, const Ns2Other&) {}
void add_row(std::string&, const Ns2Refused&) {}

}  // namespace

void write_csv_line(const Ns2Line& event, std::string& out) {
    std::visit([&](const auto& e) { add_row(out, e); }, event);
    out += '\n';
}

}  // namespace rovernet
