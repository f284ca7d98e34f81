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

// Search for receivers by computing losses with the model: the slowest method, for propagation
// models of any LossShape.

namespace rovernet {

/// Candidate in the search for receivers: a node within reach of a transmitter. Its path loss
/// determines whether it is a receiver.
struct Candidate {
    NodeId node;
    /// True if the node is at rest, and stays at rest until the next call of PairCache::moved for
    /// it.
    bool rests;
    /// Key of the candidate's robot, for random draws.
    std::uint64_t key;
    /// Position of the candidate's antenna [m].
    Vec3 antenna;
    /// Squared distance to the transmitter's antenna [m^2].
    double squared_distance;
    /// Path loss [dB] beyond which the node is not a receiver.
    double budget_db;
    /// Path loss [dB] after Candidates::compute_losses(); a value above the result of that function
    /// is only a lower bound.
    double loss_db = 0;
};

/// Candidates within reach of one transmitter, and their path losses. The propagation model is
/// called once for all candidates, except for pairs at rest whose loss is cached. Medium fills the
/// list in a search by losses (Decision::by_loss):
///
///   candidates.clear();
///   for (...) candidates.add({...});
///   candidates.compute_losses(model, links, from, cache);
///   for (const Candidate& c : candidates.all()) if (c.loss_db <= c.budget_db) ...
class Candidates {
  public:
    /// Removes all candidates; the memory is kept.
    void clear() {
        all_.clear();
        at_rest_ = 0;
        cutoff_ = Db{-std::numeric_limits<double>::infinity()};
    }
    /// Adds a candidate, without its path loss.
    void add(const Candidate& candidate) {
        all_.push_back(candidate);
        at_rest_ += candidate.rests;
        cutoff_ = std::max(cutoff_, Db{candidate.budget_db});
    }
    /// Candidates since clear(), in order; with losses after compute_losses().
    std::span<const Candidate> all() const { return all_; }

    /// Computes the losses of all candidates.
    /// @param link    links of the transmitter, without receivers
    /// @param cache   cache of losses, opened here for the transmitter if any candidate rests
    /// @param beyond  ratio [dB] above a candidate's budget up to which losses must be exact
    /// @return loss [dB] above which a candidate's loss is only a lower bound
    Db compute_losses(const Propagation& model, LinkBatch link, NodeId from, PairCache& cache,
                      Db beyond = Db{0});

  private:
    // Calls the model for the losses of the candidates in asked_.
    void ask(const Propagation& model, LinkBatch link, Db cutoff);

    // Candidates in the order in which they were added.
    std::vector<Candidate> all_;
    // Number of candidates at rest.
    std::size_t at_rest_ = 0;
    // Largest budget of all candidates [dB].
    Db cutoff_{};
    // Candidates whose loss the model computes, in its input format; kept to reuse their memory.
    std::vector<std::uint32_t> asked_;
    std::vector<Vec3> positions_;
    std::vector<std::uint64_t> keys_;
    // Losses returned by the model [dB].
    std::vector<double> loss_db_;
};

}  // namespace rovernet
