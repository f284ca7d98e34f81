// SPDX-License-Identifier: MIT
#include "experiment/replay/capture.hpp"

#include "experiment/replay/packet_on_air.hpp"
#include "experiment/replay/recorded_air.hpp"
#include "experiment/reports/link_table.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "routing/arp_packet.hpp"
#include "traces/pcapng/wifi_packet.hpp"

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

constexpr MacAddress every_station{255, 255, 255, 255, 255, 255};
constexpr std::uint32_t every_host = 0xffffffff;

/// The bytes of an address such as 02:00:00:00:00:01 or 10.0.0.1; nothing for any other text.
template <std::size_t bytes>
std::optional<std::array<std::uint8_t, bytes>> parse_address(std::string_view text, int base,
                                                             std::string_view between) {
    std::array<std::uint8_t, bytes> address{};
    for (std::size_t i = 0; i < bytes; ++i) {
        if (i > 0) {
            if (text.empty() || between.find(text.front()) == between.npos) return std::nullopt;
            text.remove_prefix(1);
        }
        const auto [end, error] =
            std::from_chars(text.data(), text.data() + text.size(), address[i], base);
        if (error != std::errc{}) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return text.empty() ? std::optional(address) : std::nullopt;
}

/// Hardware address of a robot, and the one of its IP. An address that was given as any other text
/// is replaced by one with a byte that no other has.
struct Host {
    Host(const Device& device, std::uint32_t number) {
        const auto byte = [&](int shift) { return static_cast<std::uint8_t>(number >> shift); };
        const auto its_mac = parse_address<6>(device.mac, 16, ":-");
        const auto its_ip = parse_address<4>(device.ip, 10, ".");
        mac = its_mac.value_or(MacAddress{2, 1, byte(24), byte(16), byte(8), byte(0)});
        const auto four =
            its_ip.value_or(std::array<std::uint8_t, 4>{11, byte(16), byte(8), byte(0)});
        for (const std::uint8_t each : four) ip = ip << 8 | each;
    }
    MacAddress mac;
    std::uint32_t ip = 0;
};

/// Makes packets of records.
class Capturing {
  public:
    Capturing(RecordedReader& trace, const std::string& in, const std::string& out)
        : trace_(trace),
          air_(LoadedRun(trace.run(), in)),
          file_(out, "rovernet " + trace.run().version) {
        std::uint32_t number = 0;
        for (const Device& device : devices(air_.medium(), air_.names())) {
            hosts_.emplace_back(device, ++number);
            file_.add_interface(device.robot, hosts_.back().mac);
        }
    }

    void take(const Record& record);
    Capture finish() {
        file_.close();
        made_.damage = trace_.damage();
        return std::move(made_);
    }

  private:
    void add_sent(const AirSent& sent);
    void add_received(const AirFrame& air, const Reception& reception);
    void add_packet(NodeId at, Time time, PcapngWriter::Way way, const RecordedFrame& frame,
                    std::optional<RadiotapFacts::Signal> signal);
    std::optional<PacketContent> content(const RecordedFrame& frame) const;
    PacketAddresses addresses(const AirFrame& air) const;
    arp::Station station(NodeId node) const;
    std::uint32_t ip_of(NodeId node) const;

    RecordedReader& trace_;
    RecordedAir air_;
    PcapngWriter file_;
    std::vector<Host> hosts_;  // by NodeId
    ByteWriter bytes_;
    Capture made_;
};

void Capturing::take(const Record& record) {
    air_.take(record, trace_.context());
    if (const auto* sent = std::get_if<AirSent>(&record)) {
        add_sent(*sent);
    } else if (const auto* received = std::get_if<Received>(&record)) {
        const AirFrame air{.frame = received->frame};
        for (const Reception& each : received->receptions) add_received(air, each);
    } else if (const auto* control = std::get_if<ControlReceived>(&record)) {
        add_received(control->air, control->reception);
    }
}

void Capturing::add_sent(const AirSent& sent) {
    const bool is_known = !air_.frames().empty() && air_.frames().back().begin == sent.time &&
                          air_.frames().back().air.frame.sender == sent.air.frame.sender;
    if (!is_known) {
        ++made_.left_out;
        return;
    }
    add_packet(sent.air.frame.sender, sent.time, PcapngWriter::Way::out, air_.frames().back(), {});
}

void Capturing::add_received(const AirFrame& air, const Reception& reception) {
    if (!is_decoded(reception.fate)) return;
    const bool is_data = !air.control;
    const std::uint64_t uid = is_data ? trace_.context().messages[air.frame.message].uid : 0;
    const RecordedFrame* frame = air_.frame_of(air, uid, reception);
    if (!frame) {
        ++made_.left_out;
        return;
    }
    RecordedFrame found = *frame;
    found.air.frame.message = air.frame.message;  // behind a broken chunk its slot may be another
    std::optional<RadiotapFacts::Signal> signal;
    if (!range_of(air_.medium().stations().model(air.frame.sender))) {
        signal = {Dbm{air_.arrival(found, reception.node).level_dbm},
                  air_.medium().stations().noise(reception.node)};
    }
    add_packet(reception.node, reception.time, PcapngWriter::Way::in, found, signal);
}

/// Content of a data frame as the layer whose packet it is has it; none for a message alone.
std::optional<PacketContent> Capturing::content(const RecordedFrame& frame) const {
    const Message& message = trace_.context().messages[frame.air.frame.message];
    const auto ip = [&](NodeId node) { return ip_of(node); };
    if (message.is_link_packet()) {
        return PacketContent{
            .ethertype = arp::ethertype,
            .bytes = arp::on_air(message, station(message.origin), station(message.to))};
    }
    if (!message.kind.empty()) {
        auto own = packet_on_air(message, frame.air.frame, ip);
        if (!own) return std::nullopt;
        return PacketContent{
            .ip_protocol = own->ip_protocol, .port = own->port, .bytes = std::move(own->bytes)};
    }
    auto header = header_on_air(frame.header, ip);
    if (!header) return std::nullopt;
    return PacketContent{.ip_protocol = header->ip_protocol,
                         .bytes = std::move(header->bytes),
                         .precedes_message = true};
}

/// Adds a frame to the interface of a robot that sends or receives it.
void Capturing::add_packet(NodeId at, Time time, PcapngWriter::Way way, const RecordedFrame& frame,
                           std::optional<RadiotapFacts::Signal> signal) {
    const AirFrame& air = frame.air;
    bytes_.clear();
    append_radiotap({.rate = frame.rate,
                     .frequency = air_.medium().stations().radio(air.frame.sender).frequency,
                     .signal = signal},
                    bytes_);
    if (!air.control) {
        const auto own = content(frame);
        append_data_frame(air, trace_.context().messages[air.frame.message], frame.bytes,
                          addresses(air), own ? &*own : nullptr, bytes_);
    } else {
        append_control_frame(air, addresses(air), bytes_);
    }
    file_.add_packet(at.value, time, way, bytes_.view());
    ++made_.packets;
}

PacketAddresses Capturing::addresses(const AirFrame& air) const {
    const NodeId to = air.frame.next_hop;
    PacketAddresses both{.sender = hosts_[air.frame.sender.index()].mac,
                         .receiver = to == everyone ? every_station : hosts_[to.index()].mac};
    if (air.control) return both;
    const Message& message = trace_.context().messages[air.frame.message];
    // Who forwards a protocol's broadcast is its source.
    const bool is_protocols = !message.kind.empty();
    both.origin = ip_of(is_protocols && message.to == everyone ? air.frame.sender : message.origin);
    // A request of DSR goes to everyone, and its message to the node that is sought.
    both.destination = ip_of(is_protocols && to == everyone ? everyone : message.to);
    return both;
}

std::uint32_t Capturing::ip_of(NodeId node) const {
    return node.index() < hosts_.size() ? hosts_[node.index()].ip : every_host;
}

arp::Station Capturing::station(NodeId node) const {
    // The target of a damaged trace's packet may be everyone.
    if (node.index() >= hosts_.size()) return {.mac = every_station, .ip = every_host};
    return {hosts_[node.index()].mac, hosts_[node.index()].ip};
}

}  // namespace

Capture capture_recorded(const std::string& in, const std::string& out) {
    RecordedReader trace(in);
    Capturing capturing(trace, in, out);
    while (const Record* record = trace.next()) capturing.take(*record);
    return capturing.finish();
}

}  // namespace rovernet
