// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/network.hpp"
#include "experiment/value.hpp"
#include "sim/ports.hpp"
#include "sim/record.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// What a person wants to know of a run with few robots: who said something for the first time, who
/// heard of it when and over how many hops, who arrived where, whose way was blocked, who failed.
class Timeline {
  public:
    struct Happening {
        Time time;
        NodeId node;
        std::string text;  ///< "hears \"F\" from A over 2 hops"
        Table detail;      ///< the same as data
    };

    /// The network must outlive the timeline's use as a sink; it knows the names.
    explicit Timeline(const Network& network) : network_(&network) {}

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Received>() | kind_of<Arrived>() | kind_of<NoWay>() |
               kind_of<Switched>();
    }
    void on(const Record& record, const RecordContext& context);

    const std::vector<Happening>& happenings() const { return happenings_; }

  private:
    void tell(const Sent& sent, const RecordContext& context);
    void tell(const Received& received, const RecordContext& context);
    void tell(const Arrived& arrived, const RecordContext& context);
    void tell(const NoWay& blocked, const RecordContext& context);
    void tell(const Switched& switched, const RecordContext& context);
    template <class Other>
    void tell(const Other&, const RecordContext&) {}
    bool is_news(NodeId node, const Message& message);
    Table& add(Time time, NodeId node, std::string_view event, std::string text);

    const Network* network_;
    std::vector<Happening> happenings_;
    std::vector<std::vector<std::pair<NodeId, std::string>>> known_;  // by node: origin, payload
};

}  // namespace rovernet
