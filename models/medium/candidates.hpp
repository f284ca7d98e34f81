// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/pair_cache.hpp"
#include "models/propagation/propagation.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/units.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rovernet {

/// One within reach of a transmitter.
struct Candidate {
    NodeId node;
    bool rests;               ///< stays where it is until PairCache::moved
    std::uint64_t key;        ///< the robot's, for random draws
    Vec3 antenna;             ///< [m]
    double squared_distance;  ///< [m^2] between the antennas
    double budget_db;         ///< [dB] who loses more is of no interest
    double loss_db = 0;       ///< [dB]; above the largest budget of all it says no more than that
};

/// Those within reach of one transmitter, and their path losses: the model is asked once for all of
/// them, but for pairs at rest whose loss is kept.
class Candidates {
  public:
    void clear() {
        all_.clear();
        at_rest_ = 0;
        give_up_ = Db{-std::numeric_limits<double>::infinity()};
    }
    void add(const Candidate& candidate) {
        all_.push_back(candidate);
        at_rest_ += candidate.rests;
        give_up_ = std::max(give_up_, Db{candidate.budget_db});
    }
    /// Those added since clear(), in order; with losses once compute_losses() is through.
    std::span<const Candidate> all() const { return all_; }

    /// @param link   the transmitter; its receivers are not looked at
    /// @param cache  opened for the transmitter once one of the candidates rests
    void compute_losses(const Propagation& model, LinkBatch link, NodeId from, PairCache& cache);

  private:
    void ask(const Propagation& model, LinkBatch link, Db give_up);

    std::vector<Candidate> all_;
    std::size_t at_rest_ = 0;
    Db give_up_{};
    // What is under work, kept for its memory: candidates whose loss the model is asked for.
    std::vector<std::uint32_t> asked_;
    std::vector<Vec3> positions_;
    std::vector<std::uint64_t> keys_;
    std::vector<double> loss_db_;
};

}  // namespace rovernet
