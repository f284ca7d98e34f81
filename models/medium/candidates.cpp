// SPDX-License-Identifier: MIT
#include "models/medium/candidates.hpp"

namespace rovernet {

Db Candidates::compute_losses(const Propagation& model, LinkBatch link, NodeId from,
                              PairCache& cache, Db beyond) {
    asked_.clear();
    const Db most = cutoff_ + beyond;
    const Db cutoff = at_rest_ > 0 ? cache.open(from, most) : most;
    std::size_t known = 0;
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
        const double* const kept = all_[i].rests ? cache.find(all_[i].node) : nullptr;
        if (kept) {
            all_[i].loss_db = *kept;
            ++known;
        } else {
            asked_.push_back(i);
        }
    }
    if (asked_.empty()) return cutoff;
    ask(model, link, cutoff);
    if (known == at_rest_ || !cache.renew(at_rest_)) return cutoff;
    for (const Candidate& c : all_) {
        if (c.rests) cache.keep(c.node, c.loss_db);
    }
    return cutoff;
}

void Candidates::ask(const Propagation& model, LinkBatch link, Db cutoff) {
    positions_.clear();
    keys_.clear();
    for (const std::uint32_t i : asked_) {
        positions_.push_back(all_[i].antenna);
        keys_.push_back(all_[i].key);
    }
    loss_db_.resize(asked_.size());
    link.to = positions_;
    link.to_keys = keys_;
    model.loss(link, cutoff, loss_db_);
    for (std::size_t k = 0; k < asked_.size(); ++k) all_[asked_[k]].loss_db = loss_db_[k];
}

}  // namespace rovernet
