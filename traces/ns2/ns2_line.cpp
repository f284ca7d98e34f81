// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace rovernet {
namespace {

using namespace std::string_view_literals;
using Event = Ns2Packet::Event;

struct Token {
    std::string_view text;  ///< empty at the end of the line
    int column = 0;
};

/// A broken token, fit to be shown.
std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown(text.substr(0, longest));
    for (char& c : shown) {
        if (c < ' ' || c > '~') c = '?';
    }
    return '"' + shown + (text.size() > longest ? "...\"" : "\"");
}

/// The blank-separated tokens of one line, and what they are expected to be.
class Tokens {
  public:
    Tokens(std::string_view line, const Location& where) : line_(line), where_(where) {}

    Token next() {
        while (at_ < line_.size() && line_[at_] == ' ') ++at_;
        const std::size_t begin = at_;
        while (at_ < line_.size() && line_[at_] != ' ') ++at_;
        return {line_.substr(begin, at_ - begin), static_cast<int>(begin) + 1};
    }

    [[noreturn]] void fail(Token token, std::string_view expected) const {
        Location here = where_;
        here.column = token.column;
        const auto found =
            token.text.empty() ? "the line ends" : fmt::format("found {}", quoted(token.text));
        throw InputError(here, fmt::format("{}, expected {}", found, expected));
    }

    void expect(std::string_view text) {
        const Token token = next();
        if (token.text != text) fail(token, fmt::format("\"{}\"", text));
    }
    /// The value of the key that must come next.
    Token value(std::string_view key) {
        expect(key);
        return next();
    }
    /// Takes `before` and `after` off the token's ends.
    Token within(Token token, std::string_view before, std::string_view after,
                 std::string_view expected) const {
        const auto text = token.text;
        if (text.size() < before.size() + after.size() || !text.starts_with(before) ||
            !text.ends_with(after)) {
            fail(token, expected);
        }
        return {text.substr(before.size(), text.size() - before.size() - after.size()),
                token.column + static_cast<int>(before.size())};
    }

    template <class Integer>
    Integer integer(Token token, std::string_view expected, std::uint64_t most,
                    int base = 10) const {
        std::uint64_t n = 0;
        const char* end = token.text.data() + token.text.size();
        const auto [stop, error] = std::from_chars(token.text.data(), end, n, base);
        if (error != std::errc{} || stop != end || n > most) fail(token, expected);
        return static_cast<Integer>(n);
    }
    NodeId robot(Token token, int base = 10) const {
        static const auto expected = fmt::format("a robot's number below {}", most_robots);
        return {integer<std::uint32_t>(token, expected, most_robots - 1, base)};
    }
    double number(Token token, std::string_view expected) const {
        double x = 0;
        const char* end = token.text.data() + token.text.size();
        const auto [stop, error] = std::from_chars(token.text.data(), end, x);
        if (error != std::errc{} || stop != end || !std::isfinite(x)) fail(token, expected);
        return x;
    }
    Time time(Token token) const;

  private:
    std::string_view line_;
    const Location& where_;
    std::size_t at_ = 0;
};

Time Tokens::time(Token token) const {
    constexpr auto expected = "a time in seconds with at most 9 decimals"sv;
    constexpr std::size_t decimals = 9;
    constexpr std::uint64_t longest_s = 9'200'000'000;
    constexpr std::uint64_t second_in_ns = 1'000'000'000;
    const std::size_t dot = std::min(token.text.find('.'), token.text.size());
    const Token whole{token.text.substr(0, dot), token.column};
    const auto fraction = token.text.substr(std::min(dot + 1, token.text.size()));
    if (whole.text.empty() || fraction.size() > decimals) fail(token, expected);
    std::uint64_t ns = 0;
    for (std::size_t i = 0; i < decimals; ++i) {
        const char digit = i < fraction.size() ? fraction[i] : '0';
        if (digit < '0' || digit > '9') fail(token, expected);
        ns = 10 * ns + static_cast<std::uint64_t>(digit - '0');
    }
    ns += integer<std::uint64_t>(whole, expected, longest_s) * second_in_ns;
    return Time{Duration{static_cast<std::int64_t>(ns)}};
}

/// The reasons of ns-2.35 (cmu-trace.h), and none.
bool is_reason(std::string_view text) {
    constexpr std::string_view reasons[] = {"---",  "END", "COL", "DUP",  "ERR",  "RET", "STA",
                                            "BSY",  "DST", "SLP", "NRTE", "LOOP", "TTL", "IFQ",
                                            "TOUT", "CBK", "SAL", "ARP",  "FIL",  "OUT", "XXX"};
    return std::find(std::begin(reasons), std::end(reasons), text) != std::end(reasons);
}

/// Fate of a frame that a MAC received in vain; a repeated unicast is dropped there, too.
std::optional<Fate> loss_of(std::string_view reason) {
    if (reason == "DUP") return Fate::duplicate;
    std::optional<Fate> found;
    for_each_reason([&](auto each) {
        if constexpr (std::is_same_v<decltype(each), Fate>) {
            if (reason_of(each) == LossReason{reason, "MAC"}) found = each;
        }
    });
    return found;
}

/// Reason for which a copy was dropped other than by the fate of its reception.
std::optional<DropReason> drop_of(std::string_view reason, std::string_view layer) {
    std::optional<DropReason> found;
    for_each_reason([&](auto each) {
        if constexpr (std::is_same_v<decltype(each), DropReason>) {
            if (reason_of(each) == LossReason{reason, layer}) found = each;
        }
    });
    return found;
}

/// Kind of the event, before it is known who the packet came from; nothing if it is not ours.
std::optional<Event> event_of(char op, std::string_view layer, std::string_view reason) {
    if (layer == "AGT") {
        if (op == 's') return Event::sent;
        if (op == 'r') return Event::delivered;
    } else if (layer == "RTR") {
        if (op == 's' || op == 'f') return Event::transmitted;
        if (op == 'r') return Event::received;
        if (reason == "TTL") return Event::ended_by_ttl;
        if (reason == "DUP") return Event::suppressed;
    }
    if (op != 'D') return std::nullopt;
    if (drop_of(reason, layer)) return Event::dropped;
    if (layer == "MAC" && loss_of(reason)) return Event::lost;
    return std::nullopt;
}

/// False if the line is not about one of our packets.
bool read_event(Ns2Packet& p, const Tokens& tokens, char op, Token layer, Token reason) {
    constexpr std::string_view layers[] = {"AGT", "RTR", "MAC", "IFQ", "PHY", "TRP"};
    if (std::find(std::begin(layers), std::end(layers), layer.text) == std::end(layers)) {
        tokens.fail(layer, "a layer (AGT, RTR, MAC, IFQ, PHY or TRP)");
    }
    if (!is_reason(reason.text)) tokens.fail(reason, "a reason of ns-2, or ---");
    const auto event = event_of(op, layer.text, reason.text);
    p.event = event.value_or(p.event);
    p.loss = loss_of(reason.text).value_or(p.loss);
    p.drop = drop_of(reason.text, layer.text).value_or(p.drop);
    return event.has_value();
}

void read_uid(Ns2Packet& p, const Tokens& tokens, Token token) {
    p.uid = tokens.integer<std::uint64_t>(token, "a packet's number",
                                          std::numeric_limits<std::uint64_t>::max());
    p.uid_column = token.column;
}

void read_size(Ns2Packet& p, const Tokens& tokens, Token token) {
    p.size = tokens.integer<std::uint32_t>(token, "a size in bytes",
                                           std::numeric_limits<std::uint32_t>::max());
}

void read_ttl(Ns2Packet& p, const Tokens& tokens, Token token) {
    p.ttl = tokens.integer<std::uint16_t>(token, "a ttl of at most 65535", 65535);
    p.ttl_column = token.column;
}

/// "address<separator>port"; false if the port is that of a routing agent.
bool read_origin(Ns2Packet& p, const Tokens& tokens, Token token, char separator) {
    constexpr auto expected = "a source address and port"sv;
    constexpr unsigned routing_port = 255;
    const std::size_t at = token.text.rfind(separator);
    if (at == token.text.npos) tokens.fail(token, expected);
    const Token port{token.text.substr(at + 1), token.column + static_cast<int>(at) + 1};
    p.origin = tokens.robot({token.text.substr(0, at), token.column});
    return tokens.integer<std::uint32_t>(port, expected, 0xffffffff) != routing_port;
}

/// The MAC's transmitter, from its address and the ethertype (0: no MAC has seen the packet).
void read_last_hop(Ns2Packet& p, const Tokens& tokens, Token transmitter, Token ethertype) {
    constexpr auto expected = "an ethertype in hexadecimal"sv;
    if (tokens.integer<std::uint32_t>(ethertype, expected, 0xffff, 16) != 0) {
        p.heard_from = tokens.robot(transmitter, 16);
    } else if (p.event == Event::received) {
        p.event = Event::own;
    }
    if (!p.heard_from && p.event == Event::lost) {
        tokens.fail(ethertype, "an ethertype, as a robot has received the packet");
    }
}

/// Passes over what an energy model adds; the blank after the MAC's bracket stays.
void expect_ip_mark(Tokens& tokens) {
    Token token = tokens.next();
    if (token.text == "[energy") {
        while (!token.text.empty() && !token.text.ends_with(']')) token = tokens.next();
        token = tokens.next();
    }
    if (token.text != "-------") tokens.fail(token, "\"-------\"");
}

Ns2Line parse_old_packet(char op, Token time, Tokens& tokens) {
    Ns2Packet p;
    p.time = tokens.time(time);
    const Token node = tokens.next();
    if (!node.text.empty() && node.text.find_first_not_of("0123456789") == node.text.npos) {
        return {};  // a wired line
    }
    p.node = tokens.robot(tokens.within(node, "_", "_", "a robot's number between underscores"));
    const Token layer = tokens.next();
    if (!read_event(p, tokens, op, layer, tokens.next())) return {};
    read_uid(p, tokens, tokens.next());
    if (tokens.next().text != "message") return {};
    read_size(p, tokens, tokens.next());
    tokens.within(tokens.next(), "[", "", "\"[\" and the MAC's duration");
    tokens.next();  // receiver
    const Token transmitter = tokens.next();
    read_last_hop(p, tokens, transmitter,
                  tokens.within(tokens.next(), "", "]", "an ethertype and \"]\""));
    expect_ip_mark(tokens);
    const Token source = tokens.within(tokens.next(), "[", "", "\"[\" and a source address");
    const bool application = read_origin(p, tokens, source, ':');
    p.for_one = !tokens.next().text.starts_with('-');
    read_ttl(p, tokens, tokens.next());
    tokens.within(tokens.next(), "", "]", "a next hop and \"]\"");
    if (!application) return {};
    return p;
}

Ns2Line parse_new_packet(char op, Token time_key, Tokens& tokens) {
    Ns2Packet p;
    if (time_key.text != "-t") tokens.fail(time_key, "\"-t\"");
    p.time = tokens.time(tokens.next());
    tokens.value("-Hs");
    tokens.value("-Hd");
    p.node = tokens.robot(tokens.value("-Ni"));
    for (const auto key : {"-Nx"sv, "-Ny"sv, "-Nz"sv, "-Ne"sv}) tokens.value(key);
    const Token layer = tokens.value("-Nl");
    const char event = op == 'd' ? 'D' : op;
    if (!read_event(p, tokens, event, layer, tokens.value("-Nw"))) return {};
    tokens.value("-Ma");
    tokens.value("-Md");
    const Token transmitter = tokens.value("-Ms");
    const Token ethertype = tokens.value("-Mt");
    const Token ip = tokens.next();
    if (ip.text == "-P" || (ip.text.empty() && layer.text == "MAC")) return {};  // ARP, RTS, ...
    if (ip.text != "-Is") tokens.fail(ip, "\"-Is\"");
    const Token source = tokens.next();
    p.for_one = !tokens.value("-Id").text.starts_with('-');
    if (tokens.value("-It").text != "message") return {};
    const bool application = read_origin(p, tokens, source, '.');
    read_last_hop(p, tokens, transmitter, ethertype);
    read_size(p, tokens, tokens.value("-Il"));
    tokens.value("-If");
    read_uid(p, tokens, tokens.value("-Ii"));
    read_ttl(p, tokens, tokens.value("-Iv"));
    if (!application) return {};
    return p;
}

/// M T NODE (X, Y, Z), (TO_X, TO_Y), SPEED
Ns2Line parse_move(Tokens& tokens) {
    constexpr auto place = "a coordinate [m] as in (x, y, z), (x, y), speed"sv;
    Ns2Move m;
    m.time = tokens.time(tokens.next());
    m.node = tokens.robot(tokens.next());
    const auto coordinate = [&](std::string_view before, std::string_view after) {
        return tokens.number(tokens.within(tokens.next(), before, after, place), place);
    };
    m.from.x = coordinate("(", ",");
    m.from.y = coordinate("", ",");
    m.from.z = coordinate("", "),");
    m.to.x = coordinate("(", ",");
    m.to.y = coordinate("", "),");
    m.to.z = m.from.z;
    m.speed = tokens.number(tokens.next(), "a speed [m/s]");
    return m;
}

/// v T eval {set sim_annotation {reachable UID N}}; any other annotation is somebody else's.
Ns2Line parse_annotation(Tokens& tokens) {
    tokens.next();  // the time is that of the `s AGT` line that follows
    for (const auto word : {"eval"sv, "{set"sv, "sim_annotation"sv, "{reachable"sv}) {
        if (tokens.next().text != word) return {};
    }
    Ns2Packet p;
    read_uid(p, tokens, tokens.next());
    constexpr auto expected = "a number of robots"sv;
    const Token count = tokens.within(tokens.next(), "", "}}", "a number of robots and \"}}\"");
    return Ns2Reachable{p.uid, tokens.integer<std::uint32_t>(count, expected, most_robots)};
}

bool is_packet(std::string_view op) {
    return op.size() == 1 && "srfDd"sv.find(op[0]) != std::string_view::npos;
}

/// Energy, errors, wired links, statistics of DSR, and what ns prints beside its trace.
bool is_foreign(std::string_view op) {
    return (op.size() == 1 && "Nx+-he"sv.find(op[0]) != std::string_view::npos) ||
           op.starts_with('S') || op.starts_with('#') || op == "INITIALIZE";
}

}  // namespace

Ns2Line parse_ns2_line(std::string_view line, const Location& where) {
    Tokens tokens(line, where);
    const Token op = tokens.next();
    if (op.text.empty() || is_foreign(op.text)) return {};
    if (op.text == "M") return parse_move(tokens);
    if (op.text == "v") return parse_annotation(tokens);
    if (!is_packet(op.text)) tokens.fail(op, "a line of an ns-2 trace (s, r, f, D, d, M, ...)");
    const Token second = tokens.next();
    if (second.text.starts_with('-')) return parse_new_packet(op.text[0], second, tokens);
    return parse_old_packet(op.text[0], second, tokens);
}

}  // namespace rovernet
