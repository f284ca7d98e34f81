// SPDX-License-Identifier: MIT
#include "mobility/files/movement_writer.hpp"

#include "files/word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace rovernet {
namespace {

/// Leg as actually travelled: until its end, the next leg or the end of the file.
struct Piece {
    Time start;
    Time end;
    Vec3 from;          ///< [m]
    Vec3 to;            ///< [m]
    bool jump = false;  ///< the piece before ended elsewhere
};

/// Pieces of a track until `end`, without gaps.
std::vector<Piece> pieces_of(const Track& track, Time end) {
    constexpr double rounding = 1e-6;  // [m]
    if (track.legs.empty()) {
        throw std::invalid_argument("track \"" + track.name +
                                    "\" has no leg; expected at least one leg");
    }
    std::vector<Piece> pieces;
    Vec3 here = track.legs.front().from;
    Time now = track.legs.front().start;
    const auto rest_until = [&](Time t) {
        if (t > now) pieces.push_back({now, t, here, here});
    };
    for (std::size_t i = 0; i < track.legs.size(); ++i) {
        const Leg& leg = track.legs[i];
        const Time next = i + 1 < track.legs.size() ? track.legs[i + 1].start : never;
        const Time stop = std::min({leg.end, next, end});
        if (stop <= leg.start) continue;
        if (stop == never && leg.velocity != Vec3{}) {
            throw std::invalid_argument("\"" + track.name +
                                        "\" moves for ever: expected a track that ends at a time");
        }
        rest_until(leg.start);
        const Vec3 to = stop == never ? leg.from : leg.position(stop);
        pieces.push_back({leg.start, stop, leg.from, to, distance(here, leg.from) > rounding});
        here = to;
        now = stop;
    }
    rest_until(end);
    return pieces;
}

/// Bounding box of the tracks.
struct Box {
    Vec3 low;
    Vec3 high;

    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

Box box_of(std::span<const Track> tracks, Time end) {
    if (tracks.empty()) return {};
    Box box{};
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const auto pieces = pieces_of(tracks[i], end);
        const Vec3 start = tracks[i].legs.front().from;
        if (i == 0) box = {start, start};
        box.add(start);
        for (const Piece& piece : pieces) {
            box.add(piece.from);
            box.add(piece.to);
        }
    }
    return box;
}

/// Seconds [s] with 9 decimals, exact.
std::string text_of(Time time) {
    constexpr std::int64_t ns_per_s = 1'000'000'000;
    const auto ns = time.time_since_epoch().count();
    return fmt::format("{}.{:09}", ns / ns_per_s, ns % ns_per_s);
}

template <class... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

/// Appends a comment with the field size for ns-2.
void append_field(std::string& text, const Box& box) {
    append(text,
           "# ns-2 ends with an error if a target is outside of the field; write load_flatgrid "
           "{:.0f} {:.0f}, or larger numbers\n",
           std::floor(std::max(box.high.x, 0.0)) + 1, std::floor(std::max(box.high.y, 0.0)) + 1);
    if (box.low.x <= 0 || box.low.y <= 0) {
        append(text,
               "# ns-2 also ends with an error if x or y of a target is not above 0; the smallest "
               "x in this file is {:.2f}, the smallest y is {:.2f}\n",
               box.low.x, box.low.y);
    }
}

/// Number k in the name "nk" of a node; empty for other names.
std::optional<std::uint32_t> number_in(const std::string& name) {
    std::uint32_t number = 0;
    if (!name.starts_with('n')) return std::nullopt;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + 1, end, number);
    const bool is_number = error == std::errc{} && stop == end && number < most_file_robots;
    if (!is_number || name != fmt::format("n{}", number)) return std::nullopt;
    return number;
}

/// Appends a comment for each track whose name differs from the number of its node.
void append_names(std::string& text, std::span<const Track> tracks,
                  const std::vector<std::uint32_t>& numbers) {
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (number_in(tracks[i].name) == numbers[i]) continue;
        std::string name = tracks[i].name;
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return c < ' '; }, ' ');
        append(text, "# {} -> $node_({})\n", name, numbers[i]);
    }
}

struct Departure {
    Time time;
    std::size_t track;
    std::uint32_t node;  ///< number in the file
    Piece piece;
};

std::vector<Departure> departures_of(std::span<const Track> tracks,
                                     const std::vector<std::uint32_t>& numbers, Time end) {
    std::vector<Departure> departures;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        for (const Piece& p : pieces_of(tracks[i], end)) {
            const bool moves = p.from.x != p.to.x || p.from.y != p.to.y;
            if (moves || p.jump) departures.push_back({p.start, i, numbers[i], p});
        }
    }
    std::sort(departures.begin(), departures.end(), [](const Departure& a, const Departure& b) {
        return std::tie(a.time, a.track) < std::tie(b.time, b.track);
    });
    return departures;
}

/// Stops the node and moves it: otherwise ns-2 would continue its motion to the old target.
void append_jump(std::string& text, const Departure& d) {
    const Vec3 at = d.piece.from;
    const std::string time = text_of(d.time);
    append(text, "$ns_ at {} \"$node_({}) setdest {:.9f} {:.9f} 0\"\n", time, d.node, at.x, at.y);
    append(text, "$ns_ at {} \"$node_({}) set X_ {:.9f}\"\n", time, d.node, at.x);
    append(text, "$ns_ at {} \"$node_({}) set Y_ {:.9f}\"\n", time, d.node, at.y);
    append(text, "$ns_ at {} \"$node_({}) set Z_ {:.9f}\"\n", time, d.node, at.z);
}

void append_setdest(std::string& text, const Departure& d) {
    const double dx = d.piece.to.x - d.piece.from.x;
    const double dy = d.piece.to.y - d.piece.from.y;
    if (dx == 0 && dy == 0) return;
    append(text, "$ns_ at {} \"$node_({}) setdest {:.9f} {:.9f} {:.12f}\"\n", text_of(d.time),
           d.node, d.piece.to.x, d.piece.to.y,
           std::sqrt(dx * dx + dy * dy) / seconds(d.piece.end - d.time));
}

bool leaves_the_ground(std::span<const Track> tracks, Time end) {
    const Box box = box_of(tracks, end);
    return box.low.z != 0 || box.high.z != 0;
}

}  // namespace

std::vector<std::uint32_t> node_numbers(std::span<const Track> tracks) {
    std::vector<std::uint32_t> numbers;
    for (const Track& track : tracks) {
        if (const auto number = number_in(track.name)) numbers.push_back(*number);
    }
    if (numbers.size() == tracks.size()) return numbers;
    numbers.resize(tracks.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
}

std::string setdest_text(std::span<const Track> tracks, Time end) {
    const std::vector<std::uint32_t> numbers = node_numbers(tracks);
    std::string text;
    const Box box = box_of(tracks, end);
    append(text, "# nodes: {}, max x: {:.2f}, max y: {:.2f}\n", tracks.size(), box.high.x,
           box.high.y);
    append_field(text, box);
    append_names(text, tracks, numbers);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const Vec3 at = tracks[i].legs.front().from;
        append(text, "$node_({}) set X_ {:.9f}\n", numbers[i], at.x);
        append(text, "$node_({}) set Y_ {:.9f}\n", numbers[i], at.y);
        append(text, "$node_({}) set Z_ {:.9f}\n", numbers[i], at.z);
    }
    for (const Departure& departure : departures_of(tracks, numbers, end)) {
        if (departure.piece.jump) append_jump(text, departure);
        append_setdest(text, departure);
    }
    return text;
}

std::string bonnmotion_text(std::span<const Track> tracks, Time end) {
    const bool with_z = leaves_the_ground(tracks, end);
    std::string text;
    const auto append_place = [&](Time time, Vec3 at) {
        append(text, "{} {:.9f} {:.9f}", text_of(time), at.x, at.y);
        if (with_z) append(text, " {:.9f}", at.z);
    };
    for (const Track& track : tracks) {
        append_place(track.legs.front().start, track.legs.front().from);
        for (const Piece& piece : pieces_of(track, end)) {
            const Time landing = piece.start + Duration{1};
            if (piece.jump && landing < piece.end) {
                text += ' ';
                append_place(landing, piece.from);
            }
            if (piece.end == never) continue;
            text += ' ';
            append_place(piece.end, piece.to);
        }
        text += '\n';
    }
    return text;
}

std::string bonnmotion_params(std::span<const Track> tracks, Time end) {
    const Box box = box_of(tracks, end);
    Time last = start_of_run;
    for (const Track& track : tracks) {
        for (const Piece& piece : pieces_of(track, end))
            if (piece.end != never) last = std::max(last, piece.end);
    }
    std::string text = "model=rovernet\nignore=0.0\nrandomSeed=0\n";
    append(text, "x={:.9f}\ny={:.9f}\n", box.high.x, box.high.y);
    if (leaves_the_ground(tracks, end)) append(text, "z={:.9f}\nJ=3D\n", box.high.z);
    append(text, "duration={}\nnn={}\ncircular=false\n", text_of(last), tracks.size());
    return text;
}

}  // namespace rovernet
