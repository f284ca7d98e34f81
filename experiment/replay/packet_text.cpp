// SPDX-License-Identifier: MIT
#include "experiment/replay/packet_text.hpp"

#include "routing/aodv/aodv_packets.hpp"
#include "routing/dsr/dsr_packets.hpp"

#include <span>
#include <string>

namespace rovernet {
namespace {

struct PacketText {
    Hops initial_ttl() const { return 0; }
    void send(LinkLayer&, NodeId, MessageId) {}
    void on_receive(LinkLayer&, const Frame&, std::span<Reception>) {}
    void describe(const Message& message, const Frame& frame, PacketStyle style,
                  std::string& text) const {
        if (message.protocol() == "AODV") return aodv::describe(message, frame, style, text);
        if (message.protocol() == dsr::protocol) dsr::describe(message, style, text);
    }
};

}  // namespace

const Router& packet_describer() {
    static const Router router{PacketText{}};
    return router;
}

}  // namespace rovernet
