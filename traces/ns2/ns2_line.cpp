// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_line.hpp"

#include "traces/ns2/ns2_words.hpp"

#include <algorithm>
#include <iterator>

namespace rovernet {
namespace {

using Words = Ns2Words;

/// Whether the text is a drop reason of ns-2.35 (cmu-trace.h), one of rovernet's own, or "---".
bool is_ns2_reason(std::string_view text) {
    constexpr std::string_view reasons[] = {
        "---", "COL",  "DUP",  "TTL", "SLP", "END", "ERR", "BSY", "RET", "IFQ", "NRTE", "ARP",
        "CBK", "TOUT", "LOOP", "STA", "DST", "SAL", "FIL", "OUT", "XXX", "OOR", "OWN"};
    return std::find(std::begin(reasons), std::end(reasons), text) != std::end(reasons);
}

bool is_ns2_layer(std::string_view text) {
    constexpr std::string_view layers[] = {"MAC", "RTR", "AGT", "IFQ", "PHY", "TRP"};
    return std::find(std::begin(layers), std::end(layers), text) != std::end(layers);
}

bool read_layer(Ns2Packet& p, Words& words, std::string_view word) {
    p.layer = word;
    return is_ns2_layer(word) || words.fail(word, "a layer (AGT, RTR, MAC, IFQ, PHY or TRP)");
}

bool read_reason(Ns2Packet& p, Words& words, std::string_view word) {
    p.reason = word;
    return is_ns2_reason(word) ||
           words.fail(word, "a reason for a drop as in ns-2 (COL, TTL, ...), or ---");
}

bool read_uid(Ns2Packet& p, Words& words, std::string_view word) {
    p.uid_column = words.column(word);
    return words.integer(word, p.uid, "a packet's number");
}

bool read_size(Ns2Packet& p, Words& words, std::string_view word) {
    return words.integer(word, p.size.emplace(), "a size in bytes");
}

/// "address<separator>port"
bool read_address(Words& words, std::string_view word, char separator, std::int64_t& address,
                  std::int64_t& port) {
    constexpr std::string_view expected = "an address and a port";
    const std::size_t at = word.rfind(separator);
    if (at == word.npos) return words.fail(word, expected);
    return words.integer(word.substr(0, at), address, expected) &&
           words.integer(word.substr(at + 1), port, expected);
}

constexpr std::string_view a_ttl = "a ttl";
constexpr std::string_view a_mac_field = "a hexadecimal number of the MAC header";

/// Reads an address of S-MAC, which prints it as a signed number: -1 is broadcast.
bool read_smac_address(Words& words, std::string_view word, std::uint32_t& address) {
    std::int64_t value = 0;
    if (!words.integer(word, value, "an address")) return false;
    if (value < -1 || value > 0xffffffff) return words.fail(word, "an address");
    address = static_cast<std::uint32_t>(value);
    return true;
}

/// `[dur to from type]` in hexadecimal; SMAC writes `[%.2f %d %d]`.
bool read_old_mac(Ns2Packet& p, Words& words, std::string_view first) {
    Ns2Mac& mac = p.mac.emplace();
    if (!words.strip(first, "[", "", "\"[\" and the MAC's duration")) return false;
    const bool is_smac = first.find('.') != first.npos;
    std::string_view to = words.next(), from = words.next();
    if (is_smac) {
        double duration = 0;
        mac.is_smac = true;
        return words.number(first, duration, "a duration") &&
               read_smac_address(words, to, mac.to) && words.strip(from, "", "]", "\"]\"") &&
               read_smac_address(words, from, mac.from);
    }
    std::string_view ethertype = words.next();
    return words.integer(first, mac.duration_us, a_mac_field, 16) &&
           words.integer(to, mac.to, a_mac_field, 16) &&
           words.integer(from, mac.from, a_mac_field, 16) &&
           words.strip(ethertype, "", "]", "an ethertype and \"]\"") &&
           words.integer(ethertype, mac.ethertype, a_mac_field, 16);
}

/// Reads `[energy E ei A es B et C er D]`; the first number is the remaining energy.
bool read_old_energy(Ns2Packet& p, Words& words) {
    if (!words.number(words.next(), p.energy.emplace(), "an energy [J]")) return false;
    std::string_view word = words.next();
    while (!word.empty() && !word.ends_with(']')) word = words.next();
    return !word.empty() || words.fail(word, "\"]\" after the energy");
}

/// `[from:port to:port ttl next]`, but for ARP.
bool read_old_ip(Ns2Packet& p, Words& words) {
    std::string_view source = words.peek();
    if (source.starts_with("[RE") || p.type == "ARP") {
        p.payload = words.rest();
        return true;
    }
    words.next();
    Ns2Ip& ip = p.ip.emplace();
    if (!words.strip(source, "[", "", "\"[\" and a source address") ||
        !read_address(words, source, ':', ip.from, ip.from_port) ||
        !read_address(words, words.next(), ':', ip.to, ip.to_port) ||
        !words.integer(words.next(), ip.ttl, a_ttl)) {
        return false;
    }
    std::string_view next_hop = words.next();
    if (!words.strip(next_hop, "", "]", "a next hop and \"]\"") ||
        !words.integer(next_hop, ip.next_hop, "a next hop")) {
        return false;
    }
    p.payload = words.rest();
    return true;
}

bool read_old(Ns2Packet& p, Words& words, std::string_view node) {
    if (!words.strip(node, "_", "_", "a robot's number between underscores") ||
        !words.robot(node, p.node) || !read_layer(p, words, words.next()) ||
        !read_reason(p, words, words.next()) || !read_uid(p, words, words.next())) {
        return false;
    }
    p.type = words.next();
    if (p.type.empty()) return words.fail(p.type, "a packet's type");
    if (!read_size(p, words, words.next())) return false;
    std::string_view word = words.next();
    if (word.empty()) return p.layer == "PHY" || words.fail(word, "\"[\" and the MAC's duration");
    if (!read_old_mac(p, words, word)) return false;
    word = words.next();
    if (word == "[energy") {
        if (!read_old_energy(p, words)) return false;
        word = words.next();
    }
    if (word.empty()) {
        return p.layer == "MAC" || p.layer == "PHY" || words.fail(word, "\"-------\"");
    }
    if (word != "-------") return words.fail(word, "\"-------\"");
    return read_old_ip(p, words);
}

bool read_new_start(Ns2Packet& p, Words& words, std::int64_t& next_hop) {
    const auto value = [&](std::string_view key, auto&& read) {
        return words.expect(key) && read(words.next());
    };
    const auto any = [](std::string_view) { return true; };
    const auto hop = [&](std::string_view word) {
        return words.integer(word, next_hop, "a next hop");
    };
    const auto meters = [&](double& x) {
        return [&](std::string_view word) { return words.number(word, x, "a place [m]"); };
    };
    const auto hexadecimal = [&](std::uint32_t& x) {
        return [&](std::string_view word) { return words.integer(word, x, a_mac_field, 16); };
    };
    Vec3& at = p.position.emplace();
    Ns2Mac& mac = p.mac.emplace();
    double energy = -1;
    const bool read =
        value("-Hs", any) && value("-Hd", hop) &&
        value("-Ni", [&](std::string_view word) { return words.robot(word, p.node); }) &&
        value("-Nx", meters(at.x)) && value("-Ny", meters(at.y)) && value("-Nz", meters(at.z)) &&
        value("-Ne",
              [&](std::string_view word) { return words.number(word, energy, "an energy [J]"); }) &&
        value("-Nl", [&](std::string_view word) { return read_layer(p, words, word); }) &&
        value("-Nw", [&](std::string_view word) { return read_reason(p, words, word); }) &&
        value("-Ma", hexadecimal(mac.duration_us)) && value("-Md", hexadecimal(mac.to)) &&
        value("-Ms", hexadecimal(mac.from)) && value("-Mt", hexadecimal(mac.ethertype));
    if (energy >= 0) p.energy = energy;
    return read;
}

bool read_new(Ns2Packet& p, Words& words) {
    std::int64_t next_hop = 0;
    if (!read_new_start(p, words, next_hop)) return false;
    const std::string_view word = words.peek();
    if (word.empty()) {
        return p.layer == "MAC" || p.layer == "PHY" || words.fail(word, "\"-Is\"");
    }
    if (word == "-P") {
        p.payload = words.rest();
        if (!p.payload.starts_with("-P arp")) return words.fail(word, "\"-Is\"");
        p.type = "ARP";
        return true;
    }
    Ns2Ip& ip = p.ip.emplace();
    ip.next_hop = std::max<std::int64_t>(next_hop, 0);
    if (!words.expect("-Is") || !read_address(words, words.next(), '.', ip.from, ip.from_port) ||
        !words.expect("-Id") || !read_address(words, words.next(), '.', ip.to, ip.to_port) ||
        !words.expect("-It")) {
        return false;
    }
    p.type = words.next();
    const bool read = words.expect("-Il") && read_size(p, words, words.next()) &&
                      words.expect("-If") && words.integer(words.next(), p.flow, "a flow") &&
                      words.expect("-Ii") && read_uid(p, words, words.next()) &&
                      words.expect("-Iv") && words.integer(words.next(), ip.ttl, a_ttl);
    p.payload = words.rest();
    return read;
}

bool read_tagged_place(Ns2Packet& p, Words& words) {
    constexpr std::string_view place = "a place [m] as in {x y z}";
    Vec3& at = p.position.emplace();
    std::string_view x = words.next(), y = words.next(), z = words.next();
    double energy = -1;
    const bool read = words.strip(x, "{", "", place) && words.number(x, at.x, place) &&
                      words.number(y, at.y, place) && words.strip(z, "", "}", place) &&
                      words.number(z, at.z, place) && words.expect("-N:en") &&
                      words.number(words.next(), energy, "an energy [J]");
    if (energy >= 0) p.energy = energy;
    return read;
}

/// Reads the IP header of a tagged line: its keys with numbers.
bool read_tagged_ip(Ns2Packet& p, Words& words, std::int64_t next_hop) {
    Ns2Ip& ip = p.ip.emplace();
    ip.next_hop = std::max<std::int64_t>(next_hop, 0);
    const auto integer = [&](std::string_view key, std::int64_t& value) {
        return words.expect(key) && words.integer(words.next(), value, "a whole number");
    };
    if (!integer("-IP:s", ip.from) || !integer("-IP:sp", ip.from_port) ||
        !integer("-IP:d", ip.to) || !integer("-IP:dp", ip.to_port) || !words.expect("-p")) {
        return false;
    }
    p.type = words.next();
    const bool read = words.expect("-e") && read_size(p, words, words.next()) &&
                      integer("-c", p.flow) && words.expect("-i") &&
                      read_uid(p, words, words.next()) && integer("-IP:ttl", ip.ttl);
    p.payload = words.rest();
    return read;
}

bool read_tagged(Ns2Packet& p, Words& words) {
    const auto hexadecimal = [&](std::string_view key, std::uint32_t& value) {
        return words.expect(key) && words.integer(words.next(), value, a_mac_field, 16);
    };
    std::int64_t next_hop = 0;
    if (!words.robot(words.next(), p.node) || !words.expect("-d") ||
        !words.integer(words.next(), next_hop, "a next hop") || !words.expect("-p")) {
        return false;
    }
    p.type = words.next();
    if (p.type == "MAC") p.type = {};
    Ns2Mac& mac = p.mac.emplace();
    // -M:s is the receiver and -M:d the transmitter: ns-2.35 has them in the wrong order.
    const bool read = words.expect("-k") && read_layer(p, words, words.next()) &&
                      words.expect("-i") && read_uid(p, words, words.next()) &&
                      words.expect("-N:loc") && read_tagged_place(p, words) &&
                      hexadecimal("-M:dur", mac.duration_us) && hexadecimal("-M:s", mac.to) &&
                      hexadecimal("-M:d", mac.from) && hexadecimal("-M:t", mac.ethertype);
    if (!read) return false;
    if (words.peek() == "-IP:s") return read_tagged_ip(p, words, next_hop);
    p.payload = words.rest();
    return true;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether the word is a name of letters, as in `M 0.0 nn 50 x 670 y 670 rp AODV`.
bool is_name(std::string_view word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), is_letter);
}

/// M T NODE (X, Y, Z), (TO_X, TO_Y), SPEED; or options of the script, names with values.
Ns2Line read_move(Words& words) {
    constexpr std::string_view place = "a coordinate [m] as in (x, y, z), (x, y), speed";
    Ns2Move m;
    const auto coordinate = [&](std::string_view before, std::string_view after, double& value) {
        std::string_view word = words.next();
        return words.strip(word, before, after, place) && words.number(word, value, place);
    };
    const bool has_time = words.time(words.next(), m.time);
    if (has_time && is_name(words.peek())) return Ns2Other::header;
    const bool read = has_time && words.robot(words.next(), m.node) &&
                      coordinate("(", ",", m.from.x) && coordinate("", ",", m.from.y) &&
                      coordinate("", "),", m.from.z) && coordinate("(", ",", m.to.x) &&
                      coordinate("", "),", m.to.y) &&
                      words.number(words.next(), m.speed, "a speed [m/s]");
    if (!read) return words.refused;
    m.to.z = m.from.z;
    return m;
}

/// N -t T -n NODE -e ENERGY
Ns2Line read_energy(Words& words) {
    Ns2Energy e;
    const bool read = words.expect("-t") && words.time(words.next(), e.time) &&
                      words.expect("-n") && words.robot(words.next(), e.node) &&
                      words.expect("-e") && words.number(words.next(), e.energy, "an energy [J]");
    if (!read) return words.refused;
    return e;
}

/// Reads v T eval {set sim_annotation {reachable UID N}}; other annotations are not of rovernet.
Ns2Line read_annotation(Words& words) {
    const std::string_view when = words.next();
    if (when == "-t") return Ns2Other::nam;
    Ns2Reachable r;
    if (!words.time(when, r.time)) return words.refused;
    for (const std::string_view word : {"eval", "{set", "sim_annotation", "{reachable"}) {
        if (words.next() != word) return Ns2Other::annotation;
    }
    if (!words.integer(words.next(), r.uid, "a packet's number")) return words.refused;
    std::string_view count = words.next();
    constexpr std::string_view expected = "a number of robots below 1048576 and \"}}\"";
    if (!words.strip(count, "", "}}", expected) || !words.integer(count, r.robots, expected) ||
        (r.robots >= most_robots && !words.fail(count, expected))) {
        return words.refused;
    }
    return r;
}

bool is_number(std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789.") == word.npos;
}

/// `T FROM TO TYPE SIZE FLAGS ...`, of which `third` is FROM.
bool is_wired(Words& words, std::string_view third) {
    return is_number(third) && is_number(words.next()) && !words.next().empty() &&
           is_number(words.next()) && !words.next().empty();
}

/// Reads a line of a packet, or of a wired link; `op` is its first word.
Ns2Line read_packet(char op, Words& words) {
    Ns2Packet p;
    p.op = op == 'd' ? 'D' : op == '+' ? 's' : op == 'h' ? 'f' : op;
    const bool is_of_wireless = std::string_view("srDdfx").find(op) != std::string_view::npos;
    const bool may_be_tagged = std::string_view("+rhd").find(op) != std::string_view::npos;
    const std::string_view second = words.next();
    if (second == "-t") {
        p.dialect = Ns2Dialect::new_format;
        const std::string_view time = words.next();
        if (!is_of_wireless || words.peek() == "-s") return Ns2Other::nam;
        if (words.time(time, p.time) && read_new(p, words)) return p;
        return words.refused;
    }
    if (!words.time(second, p.time)) return words.refused;
    const std::string_view third = words.next();
    if (third == "-s" && may_be_tagged) {
        p.dialect = Ns2Dialect::tagged;
        p.reason = "---";
        if (read_tagged(p, words)) return p;
        return words.refused;
    }
    if (!third.starts_with('_') && is_wired(words, third)) return Ns2Other::wired;
    if (is_of_wireless && read_old(p, words, third)) return p;
    if (!is_of_wireless) words.fail(third, "the robots of a wired link");
    return words.refused;
}

/// Whether a line is one that ns, or widely used scripts, print during a run.
bool is_of_terminal(std::string_view line) {
    constexpr std::string_view begins[] = {"INITIALIZE THE LIST",
                                           "SORTING LISTS",
                                           "channel.cc:",
                                           "highestAntennaZ_",
                                           "num_nodes is set",
                                           "warning:",
                                           "using backward compatible",
                                           "Loading ",
                                           "Starting Simulation",
                                           "NS EXITING"};
    return std::any_of(std::begin(begins), std::end(begins),
                       [&](std::string_view begin) { return line.starts_with(begin); });
}

/// Whether the word begins a line of DSR statistics: S and a name, such as SFf and S$hit.
bool is_of_dsr(std::string_view op) {
    return op.size() > 1 && op[0] == 'S' && (is_letter(op[1]) || op[1] == '$');
}

Ns2Line read_short(std::string_view op, Words& words) {
    constexpr std::string_view of_packets = "srDdfx+h-e";
    if (of_packets.find(op[0]) != of_packets.npos) return read_packet(op[0], words);
    if (op == "M") return read_move(words);
    if (op == "N") return read_energy(words);
    if (op == "v") return read_annotation(words);
    if (is_letter(op[0]) && words.peek() == "-t") return Ns2Other::nam;
    return Ns2Refused{words.column(op), op, "a line of an ns-2 trace (s, r, f, D, d, M, ...)"};
}

}  // namespace

Ns2Line parse_ns2_line(std::string_view line) {
    Words words(line);
    const std::string_view op = words.next();
    if (op.empty()) return Ns2Other::blank;
    if (op[0] == '#') return Ns2Other::comment;
    if (op.size() == 1) return read_short(op, words);
    if (is_of_terminal(line)) return Ns2Other::message;
    if (is_of_dsr(op)) return Ns2Other::dsr;
    return Ns2Refused{words.column(op), op, "a line of an ns-2 trace (s, r, f, D, d, M, ...)"};
}

}  // namespace rovernet
