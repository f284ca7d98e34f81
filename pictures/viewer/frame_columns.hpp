// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/viewer/view_file.hpp"
#include "scenario/document/value.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Limits for the frames that a view file contains.
struct FrameChoice {
    /// Earliest and latest start of a frame.
    Time from = start_of_run, to = never;
    /// Largest number of frames; later frames are left out.
    std::size_t most_frames = std::numeric_limits<std::size_t>::max();
    /// Number of bytes of a message's payload that are written; the rest is cut off.
    std::size_t payload_bytes = 64;
};

/// Identity of an application's message that is the same in all runs of a scenario, so that two
/// runs can be compared message by message.
struct MessageName {
    std::uint32_t origin;  ///< robot that sent the message
    /// number of the message among those of its robot; no_index: a control packet
    std::uint32_t number;
    friend auto operator<=>(const MessageName&, const MessageName&) = default;
};

/// Sink that collects messages, frames, receptions and losses as columns of a view file
/// (docs/formats/view-format.md). The records may come from a network, or from a recorded trace.
///
/// Memory: 40 bytes for each frame, 12 for each reception, 16 for each loss, and the messages.
class FrameColumns {
  public:
    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<AirSent>() | kind_of<Received>() |
               kind_of<ControlReceived>() | kind_of<Dropped>();
    }
    void on(const Record& record, const RecordContext& context);

    std::size_t frames() const { return flights_.size(); }
    std::size_t receptions() const { return receptions_.size(); }
    /// Number of messages of applications, without control packets.
    std::size_t messages() const;
    /// Largest number of a message's flow; 0 without messages.
    std::size_t last_flow() const;
    /// Identity of each message (MessageName), by the message's index in the columns.
    const std::vector<MessageName>& message_names() const { return messages_.name; }
    /// Number of frames that write() left out.
    std::size_t left_out() const { return left_out_; }
    /// Message that an application of a robot did not get, although the message was for it.
    struct Missed {
        std::uint32_t message;  ///< index of the message in the columns
        std::uint64_t uid;
        std::uint32_t robot;
    };
    /// List of the messages that robots missed, in the order of the messages; at most `most`
    /// entries.
    /// @param robots  number of robots
    std::vector<Missed> missed(std::size_t robots, std::size_t most) const;
    /// Writes the columns of messages, frames, receptions, losses and density, and the entries of
    /// the head that describe them.
    /// @param robots  number of robots
    /// @param end     end of the run
    void write(ViewFile& file, Table& head, std::size_t robots, Time end,
               const FrameChoice& choice);
    /// Writes the data collected since the last call, and discards it: messages, losses and density
    /// to `rest`; frames that have ended, with their receptions, to `frames`. Frames are written in
    /// the order of their starts, so a frame still on air keeps back all later frames until a later
    /// call.
    /// @param now  present time of the run; `never`: the run is over, and all frames have ended
    /// @return number of frames written
    std::size_t write_part(ViewDraft& rest, ViewDraft& frames, std::size_t robots, Time end,
                           Time now);

  private:
    struct MessageColumns {
        std::vector<double> uid, created;
        std::vector<std::uint32_t> origin, to, size;
        std::vector<std::uint16_t> flow;
        std::vector<std::uint8_t> kind;
        std::vector<std::string> payload;
        std::vector<MessageName> name;
    };
    /// Frame on air.
    struct Flight {
        std::int64_t start, airtime;  // start and duration of the transmission [ns]
        std::uint32_t sender, to, message;
        std::uint32_t before;  // index of the sender's previous flight; no_index: none
        std::uint8_t kind, ttl, hops, queue;
        std::int64_t end() const { return start + airtime; }
    };
    struct Sender {
        std::uint32_t last_flight = no_index;  // index of the robot's last flight
        std::int64_t longest = 0;              // longest airtime of the robot's flights [ns]
    };
    struct RobotReception {
        std::uint32_t flight, robot;
        std::uint8_t outcome;
    };
    struct Loss {
        std::int64_t time;
        std::uint32_t robot, message;
        std::uint8_t reason;
    };
    /// Reason of a loss, with its code.
    struct Reason {
        DropReason reason;
        LossReason loss;
        friend bool operator==(const Reason&, const Reason&) = default;
    };
    /// Message that occupies a slot of the message table, and its index in the columns.
    struct Known {
        std::uint64_t uid = ~std::uint64_t{0};
        std::uint32_t index = 0;
    };
    /// Range of indices of flights, without `end`.
    struct Block {
        std::size_t begin, end;
    };
    /// Time intervals for which the density is written: all intervals of the run, or only intervals
    /// with receptions.
    enum class Bins { all, used };
    /// List of distinct texts, in the order of first use.
    struct Names {
        std::vector<std::string> list;
        std::uint8_t index_of(std::string_view name);
    };

    void take(const AirSent& sent, const RecordContext& context);
    void take(const Dropped& dropped, const RecordContext& context);
    void take(std::uint32_t flight, const Reception& reception);
    std::uint32_t index_of(MessageId id, const RecordContext& context);
    std::uint32_t flight_of(NodeId sender, std::uint32_t message, Time received) const;
    std::vector<std::uint32_t> sort_receptions();
    void write_names(Table& head) const;
    void write_messages(ViewFile& file, std::size_t robots, std::size_t payload_bytes);
    void write_losses(ViewFile& file, Table& head, std::size_t robots) const;
    void write_density(ViewFile& file, Table& head, Time end, Bins bins) const;
    void write_counts(Table& head, std::size_t flights, std::size_t receptions) const;
    void write_places(ViewFile& file, const std::vector<Block>& blocks) const;
    void write_frames(ViewFile& file, Table& head, std::size_t robots, const FrameChoice& choice,
                      const std::vector<std::uint32_t>& first);
    Table write_block(ViewFile& file, const std::string& name, const Block& block,
                      const std::vector<std::uint32_t>& first, std::size_t robots) const;
    void forget(std::size_t flights);

    MessageColumns messages_;
    // number of messages that were discarded before those in messages_
    std::uint32_t forgotten_ = 0;
    std::vector<Known> known_;  // messages in use, by MessageId
    std::vector<Flight> flights_;
    std::vector<Sender> senders_;  // by NodeId
    std::vector<RobotReception> receptions_;
    std::vector<Loss> losses_;
    std::vector<Reason> reasons_;  // reasons in losses_, in the order of first use
    Names frame_kinds_{{"DATA"}}, message_kinds_{{""}};
    std::size_t left_out_ = 0;
    bool has_queues_ = false;  // whether some sender has a queue, and the records tell its length
};

}  // namespace rovernet
