// SPDX-License-Identifier: MIT
/// The saturated cell of bench/peers/run in ns-3.37; prints one line of JSON.
///
/// n stations and one silent sink share a place, so that no frame captures another. Each station
/// always has a frame of that payload for the sink, or for all. 802.11b ad hoc, long preamble, no
/// IP. ns-3 sends broadcasts at the rate of data and, by its timing, acknowledgements too.
#include "ns3.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ns3/config.h>
#include <ns3/double.h>
#include <ns3/mobility-helper.h>
#include <ns3/net-device-container.h>
#include <ns3/node-container.h>
#include <ns3/packet.h>
#include <ns3/txop.h>
#include <ns3/wifi-mac-header.h>
#include <ns3/wifi-mac-queue.h>
#include <ns3/wifi-mac.h>
#include <ns3/wifi-net-device.h>
#include <ns3/wifi-phy.h>
#include <ns3/yans-wifi-helper.h>
#include <string>

using namespace ns3;

namespace {

constexpr double warm_up = 1;          // [s], not counted
constexpr std::uint32_t backlog = 20;  // frames; a station sends fewer between two refills
constexpr double refill = 0.01;        // [s]

struct Options : PeerOptions {
    std::uint32_t n = 10;
    std::string mode = "unicast";
    std::string rate = "1";  // [Mb/s]
    double seconds = 20;     // counted

    Options(int argc, char** argv) : PeerOptions(1000) {
        CommandLine line;
        line.AddValue("n", "stations besides the sink", n);
        line.AddValue("mode", "unicast, rts or broadcast", mode);
        line.AddValue("rate", "1, 2, 5.5 or 11 Mb/s", rate);
        line.AddValue("seconds", "that are counted", seconds);
        read(line, argc, argv);
        require(n > 0 && (mode == "unicast" || mode == "rts" || mode == "broadcast"));
    }
};

NetDeviceContainer install(const NodeContainer& nodes, const Options& options) {
    MobilityHelper().Install(nodes);  // all at the origin
    YansWifiChannelHelper channel;
    channel.SetPropagationDelay("ns3::ConstantSpeedPropagationDelayModel");
    channel.AddPropagationLoss("ns3::RangePropagationLossModel");
    YansWifiPhyHelper phy;
    phy.SetChannel(channel.Create());

    std::string name = "DsssRate" + options.rate + "Mbps";
    std::replace(name.begin(), name.end(), '.', '_');
    return install_ad_hoc(phy, nodes, name, options.mode == "rts" ? 0 : 65535);
}

class Cell {
  public:
    Cell(const Options& options, const NetDeviceContainer& devices)
        : options_(options), devices_(devices) {
        sink()->SetReceiveCallback(MakeCallback(&Cell::receive, this));
        for (std::uint32_t i = 0; i < options.n; ++i)
            station(i)->GetPhy()->TraceConnectWithoutContext("PhyTxBegin",
                                                             MakeCallback(&Cell::transmit, this));
        Simulator::Schedule(Seconds(0), &Cell::top_up, this);
    }

    void print(const Usage& ready, const Usage& done) const {
        const double share = static_cast<double>(delivered_) * options_.payload * 8e-6 /
                             std::stod(options_.rate) / options_.seconds;
        std::printf(
            "{\"peer\": \"ns3_wifi\", \"mode\": \"%s\", \"n\": %u, \"rate_mbps\": %s, "
            "\"payload\": %u, \"seconds\": %g, \"delivered\": %lld, \"attempts\": %lld, "
            "\"collisions\": %lld, \"rts\": %lld, \"throughput_share\": %.6f, "
            "\"setup_cpu_s\": %.4f, \"run_cpu_s\": %.4f, \"rss_mb\": %.1f}\n",
            options_.mode.c_str(), options_.n, options_.rate.c_str(), options_.payload,
            options_.seconds, delivered_, attempts_, std::max(0LL, attempts_ - delivered_),
            requests_, share, ready.cpu_s, done.cpu_s - ready.cpu_s, done.rss_mb);
    }

  private:
    static bool counted() { return Simulator::Now() >= Seconds(warm_up); }

    Ptr<NetDevice> sink() const { return devices_.Get(options_.n); }

    Ptr<WifiNetDevice> station(std::uint32_t i) const {
        return DynamicCast<WifiNetDevice>(devices_.Get(i));
    }

    void top_up() {
        const auto to =
            options_.mode == "broadcast" ? sink()->GetBroadcast() : sink()->GetAddress();
        for (std::uint32_t i = 0; i < options_.n; ++i) {
            const auto queue = station(i)->GetMac()->GetTxop()->GetWifiMacQueue();
            for (auto queued = queue->GetNPackets(); queued < backlog; ++queued)
                station(i)->Send(Create<Packet>(options_.payload), to, protocol);
        }
        Simulator::Schedule(Seconds(refill), &Cell::top_up, this);
    }

    void transmit(Ptr<const Packet> packet, double /*power_w*/) {
        WifiMacHeader header;
        packet->PeekHeader(header);
        if (!counted()) return;
        attempts_ += header.IsData();
        requests_ += header.IsRts();
    }

    bool receive(Ptr<NetDevice>, Ptr<const Packet>, std::uint16_t, const Address&) {
        delivered_ += counted();
        return true;
    }

    Options options_;
    NetDeviceContainer devices_;  // the last is the sink
    long long delivered_ = 0, attempts_ = 0, requests_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    return exit_of([&] {
        const Options options(argc, argv);
        // Half a second by default: at n = 50 frames would grow old, and leave a wide window
        // behind.
        Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(1000)));
        NodeContainer nodes;
        nodes.Create(options.n + 1);
        const auto devices = install(nodes, options);
        Cell cell(options, devices);
        run_and_print(cell, warm_up + options.seconds);
    });
}
