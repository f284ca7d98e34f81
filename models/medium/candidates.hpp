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

// Search for receivers by asking the model: the slowest way, for models of any shape.

namespace rovernet {

/// Candidate for a receiver: a node within reach of a transmitter, whose loss decides whether it is
/// one.
struct Candidate {
    NodeId node;
    /// The node stays where it is until PairCache::moved.
    bool rests;
    /// Key of the robot, for random draws.
    std::uint64_t key;
    /// Position of its antenna [m].
    Vec3 antenna;
    /// Squared distance between the antennas [m^2].
    double squared_distance;
    /// Loss [dB] beyond which it is of no interest.
    double budget_db;
    /// Path loss [dB], once it is computed; one above the largest budget of all candidates says no
    /// more than that.
    double loss_db = 0;
};

/// Candidates within reach of one transmitter, and their path losses: the model is asked once for
/// all of them, but for pairs at rest whose loss is kept. Medium fills it in a search by losses
/// (Decision::by_loss):
///
///   candidates.clear();
///   for (...) candidates.add({...});
///   candidates.compute_losses(model, links, from, cache);
///   for (const Candidate& c : candidates.all()) if (c.loss_db <= c.budget_db) ...
class Candidates {
  public:
    /// Forgets all candidates; their memory stays.
    void clear() {
        all_.clear();
        at_rest_ = 0;
        give_up_ = Db{-std::numeric_limits<double>::infinity()};
    }
    /// Adds a candidate, without its loss.
    void add(const Candidate& candidate) {
        all_.push_back(candidate);
        at_rest_ += candidate.rests;
        give_up_ = std::max(give_up_, Db{candidate.budget_db});
    }
    /// Candidates since clear(), in order; with losses once compute_losses() is through.
    std::span<const Candidate> all() const { return all_; }

    /// Computes the losses of all candidates.
    /// @param link    links of the transmitter; its receivers are not looked at
    /// @param cache   opened for the transmitter once one of the candidates rests
    /// @param beyond  ratio [dB] by which losses above a candidate's budget are still of interest
    /// @return loss [dB] above which a candidate's loss says no more than that
    Db compute_losses(const Propagation& model, LinkBatch link, NodeId from, PairCache& cache,
                      Db beyond = Db{0});

  private:
    // Asks the model for the losses of the candidates in asked_.
    void ask(const Propagation& model, LinkBatch link, Db give_up);

    // Candidates in the order in which they were added.
    std::vector<Candidate> all_;
    // Candidates that rest.
    std::size_t at_rest_ = 0;
    // Largest budget of all [dB].
    Db give_up_{};
    // Candidates whose loss the model is asked for, as it wants them; kept for their memory.
    std::vector<std::uint32_t> asked_;
    std::vector<Vec3> positions_;
    std::vector<std::uint64_t> keys_;
    // Losses that the model answered [dB].
    std::vector<double> loss_db_;
};

}  // namespace rovernet
