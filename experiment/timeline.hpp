// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/chunks.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Timeline of a run with few robots, for users: a list of events with their times. Its entries are
/// the first transmission of each text by a robot, the first reception of the text at each robot
/// with the number of hops, arrivals, blocked paths, and robots that are switched off and on.
///
/// Messages whose payload is no text have no entry.
///
/// Memory: 24 bytes for each entry, 16 for each position, and about 16 for each pair of text and
/// receiver. Sentences are made when the timeline is shown.
class Timeline {
  public:
    /// Entry of the timeline as shown to the user.
    struct Happening {
        Time time;
        std::string robot;
        std::string text;  ///< event as a text: "hears \"F\" from A over 2 hops"
    };

    /// Makes an empty timeline. The network, which has the robots' names, must outlive the
    /// timeline.
    explicit Timeline(const Network& network) : network_(&network) {}

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Received>() | kind_of<Arrived>() | kind_of<NoWay>() |
               kind_of<Switched>();
    }
    void on(const Record& record, const RecordContext& context);

    /// Largest number of entries of the timeline. Traces are better suited for runs with more
    /// events.
    static constexpr std::size_t most = 10'000;

    std::size_t size() const { return entries_.size(); }
    /// Number of entries that were dropped, since the timeline already had `most` entries.
    std::uint64_t left_out() const { return left_out_; }
    /// Entry number i of the timeline, in order of time, from 0.
    Happening operator[](std::size_t i) const;
    /// Appends to `out` the entry number i (from 0) as a JSON object. All lines of the object
    /// except its first line are indented by 4 blanks.
    void append_json(std::size_t i, std::string& out) const;

  private:
    enum class Event : std::uint8_t { says, hears, arrives, finds_no_way, fails, goes_on };
    struct Entry {
        Time time;
        NodeId node;
        std::uint32_t about;  // text or position of the event, as an index into words_ or places_
        Event event;
        Hops hops;
    };
    static_assert(sizeof(Entry) == 24);
    /// Text that the robot `origin` sends as the payload of one or several messages.
    struct Words {
        NodeId origin;
        std::string payload;
    };
    /// Set of pairs (text, robot) that already have an entry: the robot has sent or received the
    /// text. Hash table with open addressing, at most two thirds full.
    class Pairs {
      public:
        /// Adds the pair of a text and the robot `node`.
        /// @param words  index of the text in Timeline::words_
        /// @return false if the set already contains this pair
        bool add(std::uint32_t words, NodeId node);

      private:
        static constexpr std::uint64_t none = ~std::uint64_t{0};
        std::vector<std::uint64_t> slots_ = std::vector<std::uint64_t>(16, none);
        std::size_t size_ = 0;
    };

    void tell(const Sent& sent, const RecordContext& context);
    void tell(const Received& received, const RecordContext& context);
    void tell(const Arrived& arrived, const RecordContext& context);
    void tell(const NoWay& blocked, const RecordContext& context);
    void tell(const Switched& switched, const RecordContext& context);
    template <class Other>
    void tell(const Other&, const RecordContext&) {}
    std::uint32_t words_of(MessageId message, const RecordContext& context);
    std::uint32_t place(Vec3 p);
    void add(const Entry& entry);
    std::string text(const Entry& entry) const;

    const Network* network_;
    Chunks<Entry> entries_;
    std::uint64_t left_out_ = 0;
    std::deque<Words> words_;  // texts, at stable addresses: word_index_ refers to their payloads
    std::map<std::pair<NodeId, std::string_view>, std::uint32_t> word_index_;
    // Uid of each message and index of its text in words_, by MessageId.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> by_message_;
    std::vector<std::pair<double, double>> places_;  // positions of events: x and y [m]
    Pairs known_;
};

}  // namespace rovernet
