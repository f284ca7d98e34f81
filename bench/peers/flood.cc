// SPDX-License-Identifier: MIT
/// The flood of bench/peers/run in ns-3.37; prints one line of JSON.
///
/// Message k leaves node 37 k mod N at 1 s + k * interval. Who first hears it re-sends it after
/// 1 us + U(0, jitter) while its TTL is above 1; copies of a known message are counted and go no
/// further.
///   --channel=lean  SimpleNetDevice; a frame reaches every node within 250 m, nothing collides
///   --channel=wifi  802.11b ad hoc at 1 Mb/s, long preamble, no IP. --loss=range: 250 m and no
///                   more; --loss=two_ray: decoded to 250 m, sensed and interfering to 550 m
#include "ns3.hpp"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <ns3/double.h>
#include <ns3/mobility-model.h>
#include <ns3/net-device-container.h>
#include <ns3/node-container.h>
#include <ns3/ns2-mobility-helper.h>
#include <ns3/packet.h>
#include <ns3/random-variable-stream.h>
#include <ns3/simple-channel.h>
#include <ns3/simple-net-device.h>
#include <ns3/yans-wifi-helper.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace ns3;

namespace {

constexpr double decode_range = 250;  // [m]
constexpr double first_message = 1;   // [s]
constexpr double least_delay = 1e-6;  // [s], rovernet's

struct Options : PeerOptions {
    std::string movement;
    std::string channel = "wifi";
    std::string loss = "range";
    std::uint32_t messages = 20;
    double interval = 3;  // [s]
    std::uint32_t ttl = 100;
    double jitter = 0.05;  // [s]

    Options(int argc, char** argv) : PeerOptions(64) {
        CommandLine line;
        line.AddValue("movement", "movement file in the syntax of ns-2", movement);
        line.AddValue("channel", "lean or wifi", channel);
        line.AddValue("loss", "range or two_ray, with --channel=wifi", loss);
        line.AddValue("messages", "how many", messages);
        line.AddValue("interval", "between two messages [s]", interval);
        line.AddValue("ttl", "of a new message", ttl);
        line.AddValue("jitter", "upper end of the delay before re-sending [s]", jitter);
        read(line, argc, argv);
        require(!movement.empty() && payload >= 8);
        require((channel == "lean" || channel == "wifi") && (loss == "range" || loss == "two_ray"));
    }
};

/// As many nodes as the file places.
std::uint32_t count_nodes(const std::string& movement) {
    std::ifstream file(movement);
    std::uint32_t nodes = 0;
    for (std::string line; std::getline(file, line);)
        if (line.rfind("$node_(", 0) == 0 && line.find("set X_") != std::string::npos) ++nodes;
    if (nodes == 0) throw std::invalid_argument("flood: no node in " + movement);
    return nodes;
}

/// Carries a frame to all within range, and makes no event for the others.
class RangeChannel : public SimpleChannel {
  public:
    void Add(Ptr<SimpleNetDevice> device) override {
        SimpleChannel::Add(device);
        const auto node = device->GetNode();
        stations_.push_back({device, node->GetObject<MobilityModel>(), node->GetId()});
    }

    void Send(Ptr<Packet> packet, std::uint16_t type, Mac48Address to, Mac48Address from,
              Ptr<SimpleNetDevice> sender) override {
        const Vector here = sender->GetNode()->GetObject<MobilityModel>()->GetPosition();
        for (const auto& station : stations_) {
            if (station.device == sender) continue;
            const double distance = CalculateDistance(here, station.mobility->GetPosition());
            if (distance > decode_range) continue;
            Simulator::ScheduleWithContext(station.node, Seconds(distance / 299792458.0),
                                           &SimpleNetDevice::Receive, station.device,
                                           packet->Copy(), type, to, from);
        }
    }

  private:
    struct Station {
        Ptr<SimpleNetDevice> device;
        Ptr<MobilityModel> mobility;
        std::uint32_t node;
    };
    std::vector<Station> stations_;
};

NetDeviceContainer install_lean(const NodeContainer& nodes) {
    const auto channel = CreateObject<RangeChannel>();
    NetDeviceContainer devices;
    for (std::uint32_t i = 0; i < nodes.GetN(); ++i) {
        const auto device = CreateObject<SimpleNetDevice>();
        device->SetAttribute("DataRate", StringValue("1Mbps"));
        device->SetAddress(Mac48Address::Allocate());
        nodes.Get(i)->AddDevice(device);
        device->SetChannel(channel);
        devices.Add(device);
    }
    return devices;
}

NetDeviceContainer install_wifi(const NodeContainer& nodes, const std::string& loss) {
    YansWifiChannelHelper channel;
    YansWifiPhyHelper phy;
    channel.SetPropagationDelay("ns3::ConstantSpeedPropagationDelayModel");
    if (loss == "two_ray")
        set_two_ray(channel, phy, decode_range, 550);
    else
        channel.AddPropagationLoss("ns3::RangePropagationLossModel", "MaxRange",
                                   DoubleValue(decode_range));
    phy.SetChannel(channel.Create());

    return install_ad_hoc(phy, nodes, "DsssRate1Mbps");
}

class Flood {
  public:
    Flood(const Options& options, const NetDeviceContainer& devices)
        : options_(options),
          devices_(devices),
          known_(options.messages, std::vector<bool>(devices.GetN())),
          delivered_(options.messages),
          delay_(CreateObject<UniformRandomVariable>()) {
        delay_->SetAttribute("Max", DoubleValue(options.jitter));
        for (std::uint32_t i = 0; i < devices.GetN(); ++i)
            devices.Get(i)->SetReceiveCallback(MakeCallback(&Flood::receive, this));
        for (std::uint32_t k = 0; k < options.messages; ++k)
            Simulator::Schedule(Seconds(first_message + k * options.interval), &Flood::begin, this,
                                k);
    }

    double end() const { return first_message + options_.messages * options_.interval + 2; }

    void print(const Usage& ready, const Usage& done) const {
        const double others = devices_.GetN() - 1.0;
        double sum = 0;
        std::string each;
        for (const auto count : delivered_) {
            sum += count;
            each += (each.empty() ? "" : ", ") + number(count / others);
        }
        std::printf(
            "{\"peer\": \"ns3_%s%s\", \"nodes\": %u, \"messages\": %u, \"delivery_ratio\": %s, "
            "\"transmissions\": %llu, \"receptions\": %llu, \"setup_cpu_s\": %.4f, "
            "\"run_cpu_s\": %.4f, \"rss_mb\": %.1f, \"events\": %llu, "
            "\"delivery_by_message\": [%s]}\n",
            options_.channel.c_str(), options_.loss == "two_ray" ? "_two_ray" : "", devices_.GetN(),
            options_.messages, number(sum / others / options_.messages).c_str(), transmissions_,
            receptions_, ready.cpu_s, done.cpu_s - ready.cpu_s, done.rss_mb,
            static_cast<unsigned long long>(Simulator::GetEventCount()), each.c_str());
    }

  private:
    struct Content {
        std::uint32_t message, ttl;
    };

    static std::string number(double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%.6f", value);
        return text;
    }

    void begin(std::uint32_t message) {
        const std::uint32_t origin = 37 * message % devices_.GetN();
        known_[message][origin] = true;
        send(origin, {message, options_.ttl});
    }

    void send(std::uint32_t node, Content content) {
        std::vector<std::uint8_t> bytes(options_.payload);
        std::memcpy(bytes.data(), &content, sizeof content);
        const auto device = devices_.Get(node);
        ++transmissions_;
        device->Send(Create<Packet>(bytes.data(), options_.payload), device->GetBroadcast(),
                     protocol);
    }

    bool receive(Ptr<NetDevice> device, Ptr<const Packet> packet, std::uint16_t, const Address&) {
        ++receptions_;
        Content content;
        packet->CopyData(reinterpret_cast<std::uint8_t*>(&content), sizeof content);
        const std::uint32_t node = device->GetNode()->GetId();
        if (known_[content.message][node]) return true;
        known_[content.message][node] = true;
        ++delivered_[content.message];
        if (content.ttl > 1)
            Simulator::Schedule(Seconds(least_delay + delay_->GetValue()), &Flood::send, this, node,
                                Content{content.message, content.ttl - 1});
        return true;
    }

    Options options_;
    NetDeviceContainer devices_;
    std::vector<std::vector<bool>> known_;  // by message, then node
    std::vector<std::uint32_t> delivered_;  // by message
    Ptr<UniformRandomVariable> delay_;      // [s]
    unsigned long long transmissions_ = 0, receptions_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    return exit_of([&] {
        const Options options(argc, argv);
        NodeContainer nodes;
        nodes.Create(count_nodes(options.movement));
        Ns2MobilityHelper(options.movement).Install();
        const auto devices =
            options.channel == "lean" ? install_lean(nodes) : install_wifi(nodes, options.loss);
        Flood flood(options, devices);
        run_and_print(flood, flood.end());
    });
}
