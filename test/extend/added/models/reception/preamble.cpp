// SPDX-License-Identifier: MIT
#include "models/reception/preamble.hpp"

#include "models/reception/interference.hpp"

namespace rovernet {
namespace {

class PreambleJudge final : public Judge {
  public:
    explicit PreambleJudge(const Preamble& model) : model_(model) {}

    bool looks_back() const override { return false; }
    void judge(Interference& air, const Emission& frame, Frames others,
               Reception& reception) override {
        const Time begin = reception.time - (frame.end - frame.begin);
        for (const Emission* each : others) {
            const auto other = air.arrival(*each, reception.node);
            if (!other || other->end <= begin || other->begin >= reception.time) continue;
            if (other->own) reception.fate = Fate::busy;
            if (!other->own && other->begin < begin + model_.length) {
                reception.fate = Fate::collided;
            }
        }
    }

  private:
    Preamble model_;
};

}  // namespace

std::unique_ptr<Judge> Preamble::make_judge() const {
    return std::make_unique<PreambleJudge>(*this);
}

}  // namespace rovernet
