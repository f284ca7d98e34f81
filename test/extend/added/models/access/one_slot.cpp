// SPDX-License-Identifier: MIT
#include "models/access/one_slot.hpp"

#include "models/phy/wifi.hpp"

#include <map>

namespace rovernet {
namespace {

class OneSlotAccess final : public Access {
  public:
    explicit OneSlotAccess(const OneSlot& settings) : settings_(settings) {}

    void send(Air& air, const QueuedFrame& frame) override {
        const std::uint32_t number = next_++;
        const double u = air.access_draw(frame.frame.sender, number);
        waiting_[number] = frame;
        const Duration wait = from_seconds(u * seconds(settings_.wait));
        air.access_timer(frame.frame.sender, air.now() + wait, number);
    }
    void on_timer(Air& air, NodeId /*node*/, std::uint32_t number) override {
        const auto frame = waiting_.extract(number);
        if (!frame) return;  // lost meanwhile
        air.transmit({.frame = frame.mapped().frame, .heard_from = frame.mapped().heard_from});
        air.sent(frame.mapped());
    }
    void switch_off(Air& air, NodeId node) override {
        std::erase_if(waiting_, [&](const auto& each) {
            const bool is_its = each.second.frame.sender == node;
            if (is_its) air.lost(each.second, DropReason::end);
            return is_its;
        });
    }

    Phy phy() const override { return Wifi{}; }

  private:
    OneSlot settings_;
    std::uint32_t next_ = 0;
    std::map<std::uint32_t, QueuedFrame> waiting_;  // by number
};

}  // namespace

std::unique_ptr<Access> OneSlot::make_access() const {
    return std::make_unique<OneSlotAccess>(*this);
}

}  // namespace rovernet
