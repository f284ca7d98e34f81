// SPDX-License-Identifier: MIT
#pragma once

#include "usage.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <ns3/command-line.h>
#include <ns3/double.h>
#include <ns3/net-device-container.h>
#include <ns3/node-container.h>
#include <ns3/rng-seed-manager.h>
#include <ns3/simulator.h>
#include <ns3/string.h>
#include <ns3/uinteger.h>
#include <ns3/wifi-helper.h>
#include <ns3/wifi-mac-helper.h>
#include <ns3/yans-wifi-helper.h>
#include <stdexcept>
#include <string>
#include <unistd.h>

/// Common parts of the ns-3.37 programs in bench/peers: options, radios, run and output.

constexpr std::uint16_t protocol = 0x88b5;  // EtherType for local experiments (IEEE 802)

/// Options of every program: --payload and --seed.
struct PeerOptions {
    std::uint32_t payload;  // bytes of data in each packet
    std::uint32_t seed = 1;

    explicit PeerOptions(std::uint32_t usual_payload) : payload(usual_payload) {}
    /// Reads the options of `line` and the options of every program.
    void read(ns3::CommandLine& line, int argc, char** argv) {
        line.AddValue("payload", "[B]", payload);
        line.AddValue("seed", "run number of ns-3's streams", seed);
        line.Parse(argc, argv);
        ns3::RngSeedManager::SetRun(seed);
    }
    static void require(bool sense) {
        if (!sense)
            throw std::invalid_argument(
                "an option is missing, or an option has a value that is not allowed; --help lists "
                "the options");
    }
};

/// Installs 802.11b ad hoc devices with the long preamble that send all data at `rate`, including
/// broadcasts.
/// @param rts_threshold  size [bytes] above which a unicast is preceded by an RTS
inline ns3::NetDeviceContainer install_ad_hoc(const ns3::YansWifiPhyHelper& phy,
                                              const ns3::NodeContainer& nodes,
                                              const std::string& rate,
                                              std::uint32_t rts_threshold = 65535) {
    const ns3::StringValue data(rate), control("DsssRate1Mbps");
    ns3::WifiHelper wifi;
    wifi.SetStandard(ns3::WIFI_STANDARD_80211b);
    wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode", data, "ControlMode",
                                 control, "NonUnicastMode", data, "RtsCtsThreshold",
                                 ns3::UintegerValue(rts_threshold));
    ns3::WifiMacHelper mac;
    mac.SetType("ns3::AdhocWifiMac");
    return wifi.Install(phy, mac, nodes);
}

/// Received power [dBm] over flat ground at a distance [m] > 86 m, for 24.5 dBm of transmit power
/// and antennas 1.5 m high.
inline double two_ray_dbm(double distance) {
    return 24.5 + 40 * std::log10(1.5) - 40 * std::log10(distance);
}

/// Sets flat ground, on which frames are decoded up to the distance `decode` [m] and sensed up to
/// `sense` [m].
inline void set_two_ray(ns3::YansWifiChannelHelper& channel, ns3::YansWifiPhyHelper& phy,
                        double decode, double sense) {
    using ns3::DoubleValue;
    // ns-3 compares the sensitivity with the power in 20 MHz, but a channel of 802.11b is 22 MHz
    // wide.
    const double of_20_mhz = two_ray_dbm(sense) - 10 * std::log10(22.0 / 20);
    channel.AddPropagationLoss("ns3::TwoRayGroundPropagationLossModel", "Frequency",
                               DoubleValue(914e6), "HeightAboveZ", DoubleValue(1.5));
    phy.Set("TxPowerStart", DoubleValue(24.5));
    phy.Set("TxPowerEnd", DoubleValue(24.5));
    phy.Set("RxSensitivity", DoubleValue(of_20_mhz));
    phy.Set("CcaEdThreshold", DoubleValue(two_ray_dbm(sense)));
    phy.SetPreambleDetectionModel("ns3::ThresholdPreambleDetectionModel", "MinimumRssi",
                                  DoubleValue(two_ray_dbm(decode)));
}

/// Runs for `length` [s], prints the counts of `bench` and ends the program without destructors,
/// because ns-3's destructors take long and sometimes crash.
template <class Bench>
[[noreturn]] void run_and_print(const Bench& bench, double length) {
    const Usage ready = Usage::now();
    ns3::Simulator::Stop(ns3::Seconds(length));
    ns3::Simulator::Run();
    bench.print(ready, Usage::now());
    std::fflush(stdout);
    _exit(0);
}

/// Calls `run` and prints the message of an exception. @return exit code of the program
template <class Run>
int exit_of(Run run) {
    try {
        run();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
