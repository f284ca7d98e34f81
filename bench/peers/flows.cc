// SPDX-License-Identifier: MIT
/// The flows of bench/peers/run in ns-3.37; prints one line of JSON.
///
/// --cell=FILE has lines "node X Y" [m] and "flow FROM TO". Each flow always has a unicast of that
/// payload to send. 802.11b ad hoc, long preamble, no IP; two-ray ground at 914 MHz, decoded to
/// 250 m, sensed to --sense [m]. ns-3 answers at the rate of data.
#include "ns3.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <ns3/config.h>
#include <ns3/mobility-helper.h>
#include <ns3/net-device-container.h>
#include <ns3/node-container.h>
#include <ns3/packet.h>
#include <ns3/position-allocator.h>
#include <ns3/txop.h>
#include <ns3/wifi-mac-queue.h>
#include <ns3/wifi-mac.h>
#include <ns3/wifi-net-device.h>
#include <ns3/yans-wifi-helper.h>
#include <string>
#include <vector>

using namespace ns3;

namespace {

constexpr double warm_up = 1;          // [s], not counted
constexpr std::uint32_t backlog = 20;  // frames; a station sends fewer between two refills
constexpr double refill = 0.01;        // [s]

struct Options : PeerOptions {
    std::string cell;
    double sense = 250;      // [m]
    std::string rate = "1";  // [Mb/s]
    double seconds = 20;     // counted

    Options(int argc, char** argv) : PeerOptions(1000) {
        CommandLine line;
        line.AddValue("cell", "file of nodes and flows", cell);
        line.AddValue("sense", "how far a frame is sensed [m]", sense);
        line.AddValue("rate", "1, 2, 5.5 or 11 Mb/s", rate);
        line.AddValue("seconds", "that are counted", seconds);
        read(line, argc, argv);
        require(!cell.empty());
    }
};

struct Flow {
    std::uint32_t from, to;
    long long delivered = 0;
};

struct CellFile {
    std::vector<Vector> places;
    std::vector<Flow> flows;

    explicit CellFile(const std::string& path) {
        std::ifstream file(path);
        std::string what;
        double a = 0, b = 0;
        while (file >> what >> a >> b) {
            if (what == "node") places.emplace_back(a, b, 0);
            if (what == "flow")
                flows.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
        }
        PeerOptions::require(!flows.empty());
    }
};

NetDeviceContainer install(const NodeContainer& nodes, const CellFile& cell,
                           const Options& options) {
    const auto places = CreateObject<ListPositionAllocator>();
    for (const Vector& place : cell.places) places->Add(place);
    MobilityHelper mobility;
    mobility.SetPositionAllocator(places);
    mobility.Install(nodes);
    YansWifiChannelHelper channel;
    YansWifiPhyHelper phy;
    channel.SetPropagationDelay("ns3::ConstantSpeedPropagationDelayModel");
    set_two_ray(channel, phy, 250, options.sense);
    phy.SetChannel(channel.Create());
    std::string name = "DsssRate" + options.rate + "Mbps";
    std::replace(name.begin(), name.end(), '.', '_');
    return install_ad_hoc(phy, nodes, name);
}

class Bench {
  public:
    Bench(const Options& options, CellFile cell, const NetDeviceContainer& devices)
        : options_(options), flows_(std::move(cell.flows)), devices_(devices) {
        for (std::uint32_t i = 0; i < devices.GetN(); ++i)
            devices.Get(i)->SetReceiveCallback(MakeCallback(&Bench::receive, this));
        Simulator::Schedule(Seconds(0), &Bench::top_up, this);
    }

    void print(const Usage&, const Usage&) const {
        long long sum = 0;
        std::string each;
        for (const Flow& flow : flows_) {
            char text[32];
            std::snprintf(text, sizeof text, "%.2f",
                          static_cast<double>(flow.delivered) / options_.seconds);
            each += (each.empty() ? "" : ", ") + std::string(text);
            sum += flow.delivered;
        }
        std::printf("{\"peer\": \"ns3_wifi\", \"frames_per_s\": %.2f, \"by_flow\": [%s]}\n",
                    static_cast<double>(sum) / options_.seconds, each.c_str());
    }

  private:
    void top_up() {
        for (const Flow& flow : flows_) {
            const auto device = DynamicCast<WifiNetDevice>(devices_.Get(flow.from));
            const auto queue = device->GetMac()->GetTxop()->GetWifiMacQueue();
            for (auto queued = queue->GetNPackets(); queued < backlog; ++queued)
                device->Send(Create<Packet>(options_.payload), devices_.Get(flow.to)->GetAddress(),
                             protocol);
        }
        Simulator::Schedule(Seconds(refill), &Bench::top_up, this);
    }

    bool receive(Ptr<NetDevice> device, Ptr<const Packet>, std::uint16_t, const Address& from) {
        if (Simulator::Now() < Seconds(warm_up)) return true;
        for (Flow& flow : flows_) {
            flow.delivered +=
                devices_.Get(flow.from)->GetAddress() == from && devices_.Get(flow.to) == device;
        }
        return true;
    }

    Options options_;
    std::vector<Flow> flows_;
    NetDeviceContainer devices_;
};

}  // namespace

int main(int argc, char** argv) {
    return exit_of([&] {
        const Options options(argc, argv);
        Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(1000)));
        const CellFile cell(options.cell);
        NodeContainer nodes;
        nodes.Create(static_cast<std::uint32_t>(cell.places.size()));
        const auto devices = install(nodes, cell, options);
        Bench bench(options, cell, devices);
        run_and_print(bench, warm_up + options.seconds);
    });
}
