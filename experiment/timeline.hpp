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

/// Timeline of a run with few robots, for a person: who said something for the first time, who
/// heard of it when and over how many hops, who arrived where, whose way was blocked, who failed.
///
/// An entry takes 24 bytes, a place 16 more, and 16 or so for each pair of words and robot that
/// heard them; text is made of it when it is shown.
class Timeline {
  public:
    /// An entry as it is shown.
    struct Happening {
        Time time;
        std::string robot;
        std::string text;  ///< "hears \"F\" from A over 2 hops"
    };

    /// The network must outlive the timeline; it knows the names.
    explicit Timeline(const Network& network) : network_(&network) {}

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Received>() | kind_of<Arrived>() | kind_of<NoWay>() |
               kind_of<Switched>();
    }
    void on(const Record& record, const RecordContext& context);

    std::size_t size() const { return entries_.size(); }
    /// The i-th entry, in the order in which they happened.
    Happening operator[](std::size_t i) const;
    /// Appends the i-th entry as a JSON object; its lines but the first are indented by four
    /// blanks.
    void append_json(std::size_t i, std::string& out) const;

  private:
    enum class Event : std::uint8_t { says, hears, arrives, finds_no_way, fails, goes_on };
    struct Entry {
        Time time;
        NodeId node;
        std::uint32_t about;  // an index into words_ or places_
        Event event;
        Hops hops;
    };
    static_assert(sizeof(Entry) == 24);
    /// Words that a robot says: in one message, or again in later ones.
    struct Words {
        NodeId origin;
        std::string payload;
    };
    /// Pairs of words and robot, in an open-addressed table at most two thirds full.
    class Pairs {
      public:
        /// Adds a pair. @return false if it was there already
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
    std::string text(const Entry& entry) const;

    const Network* network_;
    Chunks<Entry> entries_;
    std::deque<Words> words_;  // stable: the index refers to their payloads
    std::map<std::pair<NodeId, std::string_view>, std::uint32_t> word_index_;
    // By message: its uid and its words.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> by_message_;
    std::vector<std::pair<double, double>> places_;  // [m]
    Pairs known_;
};

}  // namespace rovernet
