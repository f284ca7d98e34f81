// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_reader.hpp"

#include "sim/error.hpp"
#include "traces/ns2/ns2_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>  // order never observed
#include <vector>

namespace rovernet {
namespace {

using Event = Ns2Packet::Event;

/// The lines of a file, read in portions.
class Lines {
  public:
    explicit Lines(const std::string& path)
        : where_{.source = path}, file_(std::fopen(path.c_str(), "rb")), buffer_(portion) {
        if (!file_) fail(fmt::format("cannot open the trace: {}", std::strerror(errno)));
        std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    }

    /// The next line without its end; nothing after the last. Valid until the next call.
    std::optional<std::string_view> next() {
        std::size_t length = line_length();
        while (length == none && !at_end_) {
            fill();
            length = line_length();
        }
        if (length == none && begin_ == end_) return std::nullopt;
        if (where_.line < std::numeric_limits<int>::max()) ++where_.line;
        const std::size_t n = length == none ? end_ - begin_ : length;
        if (n > longest) fail(fmt::format("a line is longer than {} bytes", longest));
        std::string_view line(buffer_.data() + begin_, n);
        begin_ += n + (length == none ? 0 : 1);
        scanned_ = 0;
        if (line.ends_with('\r')) line.remove_suffix(1);
        return line;
    }
    const Location& where() const { return where_; }

  private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    static constexpr std::size_t longest = 64 * 1024;
    static constexpr std::size_t portion = 4 * longest;

    std::size_t line_length() {
        const char* begin = buffer_.data() + begin_;
        const auto* found =
            static_cast<const char*>(std::memchr(begin + scanned_, '\n', end_ - begin_ - scanned_));
        scanned_ = end_ - begin_;
        return found ? static_cast<std::size_t>(found - begin) : none;
    }
    void fill() {
        const std::size_t rest = end_ - begin_;
        if (rest > longest) {
            ++where_.line;
            fail(fmt::format("a line is longer than {} bytes", longest));
        }
        std::memmove(buffer_.data(), buffer_.data() + begin_, rest);
        begin_ = 0;
        const std::size_t n = std::fread(buffer_.data() + rest, 1, portion - rest, file_.get());
        if (std::ferror(file_.get())) {
            where_.line = 0;
            fail(fmt::format("cannot read the trace: {}", std::strerror(errno)));
        }
        at_end_ = n == 0;
        end_ = rest + n;
    }
    [[noreturn]] void fail(const std::string& message) {
        if (where_.line > 0) where_.column = 1;
        throw InputError(where_, message);
    }

    struct Close {
        void operator()(std::FILE* f) const { std::fclose(f); }
    };
    Location where_;
    std::unique_ptr<std::FILE, Close> file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;    ///< of the current line
    std::size_t end_ = 0;      ///< of what has been read
    std::size_t scanned_ = 0;  ///< bytes from begin_ without an end of line
    bool at_end_ = false;
};

/// Turns lines into records.
class Replay {
  public:
    Replay(Sink sink, const Location& where)
        : sink_(std::move(sink)), where_(where), context_{legs_, messages_} {}

    void on(std::monostate) {}
    void on(const Ns2Reachable& r) { reachable_ = r; }
    void on(const Ns2Move&);
    void on(const Ns2Packet&);
    /// The last reception is complete.
    void flush();

  private:
    struct Copy {
        Frame frame;
        Reception reception;
        std::uint64_t uid;
    };

    void sent(const Ns2Packet&);
    void continue_reception(const Ns2Packet&);
    Frame frame_of(const Ns2Packet&);
    void know(NodeId node);
    template <class R>
    void emit(const R& record) {
        if (sink_.kinds() & kind_of<R>()) sink_.on(record, context_);
    }
    [[noreturn]] void fail(int column, const std::string& message) const {
        Location here = where_;
        here.column = column;
        throw InputError(here, message);
    }

    Sink sink_;
    const Location& where_;
    Legs legs_;
    MessageTable messages_;
    RecordContext context_;
    std::unordered_map<std::uint64_t, MessageId> by_uid_;
    std::vector<Hops> initial_ttl_;          ///< by MessageId
    std::vector<std::uint32_t> numbers_;     ///< by robot: its messages so far
    std::vector<bool> placed_;               ///< by robot: it has had an M line
    std::uint32_t robots_ = 0;               ///< robots that have
    std::optional<Ns2Reachable> reachable_;  ///< the last annotation
    std::optional<Copy> open_;               ///< a reception that the next lines may go on with
};

void Replay::know(NodeId node) {
    while (legs_.size() <= node.index()) legs_.add(Leg{});
    placed_.resize(legs_.size());
    numbers_.resize(legs_.size());
}

Leg leg_of(const Ns2Move& m) {
    Leg leg{.start = m.time, .end = never, .from = m.from, .velocity = {}, .to = m.from};
    const double length = distance(m.from, m.to);
    if (!(m.speed > 0) || !(length > 0) || !std::isfinite(length)) return leg;
    leg.velocity = (m.speed / length) * (m.to - m.from);
    leg.to = m.to;
    constexpr double longest_s = 9e9;  // half of the clock's range: start + duration stays in it
    const double duration_s = length / m.speed;
    if (duration_s < longest_s && seconds(m.time) + duration_s < longest_s) {
        leg.end = m.time + from_seconds(duration_s);
    }
    return leg;
}

void Replay::on(const Ns2Move& m) {
    flush();
    know(m.node);
    if (!placed_[m.node.index()]) ++robots_;
    placed_[m.node.index()] = true;
    legs_.replace(m.node, leg_of(m));
    emit(Moved{m.time, m.node, legs_.leg(m.node)});
}

void Replay::sent(const Ns2Packet& p) {
    know(p.origin);
    const auto [entry, is_new] = by_uid_.try_emplace(p.uid);
    if (!is_new) fail(p.uid_column, fmt::format("message {} is sent a second time", p.uid));
    const MessageId id = messages_.add({.origin = p.origin,
                                        .uid = p.uid,
                                        .number = numbers_[p.origin.index()]++,
                                        .key = 0,
                                        .size = p.size,
                                        .created = p.time,
                                        .payload = {}});
    entry->second = id;
    initial_ttl_.push_back(p.ttl);
    const std::uint32_t robots = p.for_one ? 2 : std::max(robots_, 1U);
    Sent record{p.time, p.node, id, p.ttl, robots, std::nullopt};
    if (reachable_ && reachable_->uid == p.uid) record.reachable = reachable_->robots;
    reachable_.reset();
    emit(record);
}

/// The frame of a line that is not the first of its message.
Frame Replay::frame_of(const Ns2Packet& p) {
    const auto found = by_uid_.find(p.uid);
    if (found == by_uid_.end()) {
        fail(p.uid_column, fmt::format("found a copy of message {}, expected its \"s AGT\" line "
                                       "before it",
                                       p.uid));
    }
    const int hops = initial_ttl_[found->second.index()] - p.ttl + 1;
    if (hops < 1 || hops > 65535) {
        fail(p.ttl_column, fmt::format("found ttl {}, expected at most that of the message, {}",
                                       p.ttl, initial_ttl_[found->second.index()]));
    }
    const NodeId sender = p.event == Event::transmitted ? p.node : p.heard_from.value_or(p.node);
    know(sender);
    return {.message = found->second,
            .sender = sender,
            .path = 0,
            .ttl = p.ttl,
            .hops = static_cast<Hops>(hops)};
}

/// A line that goes on with the reception of the line before.
void Replay::continue_reception(const Ns2Packet& p) {
    if (!open_ || open_->uid != p.uid || open_->reception.node != p.node ||
        open_->reception.time != p.time || open_->reception.fate != Fate::waiting ||
        (p.event == Event::delivered && open_->reception.delivered)) {
        fail(1, fmt::format("found what became of a copy of message {} at robot {}, expected its "
                            "\"r RTR\" line directly before it",
                            p.uid, p.node.value));
    }
    Reception& rx = open_->reception;
    if (p.event == Event::delivered) rx.delivered = true;
    if (p.event == Event::ended_by_ttl) rx.fate = Fate::ttl;
    if (p.event == Event::suppressed) rx.fate = Fate::duplicate;
}

void Replay::on(const Ns2Packet& p) {
    know(p.node);
    if (p.event == Event::delivered || p.event == Event::ended_by_ttl ||
        p.event == Event::suppressed) {
        return continue_reception(p);
    }
    flush();
    if (p.event == Event::own) return;
    // MACs of others lose packets that we know nothing of.
    const bool of_a_mac = p.event == Event::lost || p.event == Event::dropped;
    if (of_a_mac && !by_uid_.contains(p.uid)) return;
    if (p.event == Event::sent) return sent(p);
    const Frame frame = frame_of(p);
    if (p.event == Event::transmitted) {
        emit(Transmitted{p.time, frame, p.heard_from});
    } else if (p.event == Event::dropped) {
        emit(Dropped{p.time, p.node, frame, p.drop});
    } else {
        const Fate fate = p.event == Event::lost ? p.loss : Fate::waiting;
        open_ = Copy{frame, {p.time, p.node, fate, false}, p.uid};
    }
}

void Replay::flush() {
    if (!open_) return;
    emit(Received{open_->frame, {&open_->reception, 1}});
    open_.reset();
}

}  // namespace

std::optional<Location> read_ns2_trace(const std::string& path, Sink sink) {
    Lines lines(path);
    Replay replay(std::move(sink), lines.where());
    std::optional<Location> skipped;
    while (const auto text = lines.next()) {
        const Ns2Line line = parse_ns2_line(*text, lines.where());
        const std::size_t begin = text->find_first_not_of(" \t");
        const bool says_something = begin != text->npos && (*text)[begin] != '#';
        if (line.index() == 0 && says_something && !skipped) {
            skipped = lines.where();
            skipped->column = 1;
        }
        std::visit([&](const auto& l) { replay.on(l); }, line);
    }
    replay.flush();
    return skipped;
}

MetricValues trace_metrics(const std::string& path) {
    const auto metrics = std::make_shared<Metrics>();
    const std::optional<Location> skipped = read_ns2_trace(path, metrics);
    MetricValues values = metrics->values();
    if (skipped && values.messages == 0) {
        throw InputError(*skipped,
                         "found a line of another trace, and no message that a robot sends; "
                         "expected a trace that rovernet writes: those of other programs, and of "
                         "other traffic than messages, cannot be counted yet");
    }
    return values;
}

}  // namespace rovernet
