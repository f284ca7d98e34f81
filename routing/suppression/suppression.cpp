// SPDX-License-Identifier: MIT
#include "routing/relay.hpp"
#include "routing/suppression/cluster_router.hpp"
#include "routing/suppression/disc_cover.hpp"
#include "routing/suppression/suppression_router.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rovernet {

Suppression::operator Router() const {
    if (scheme == SuppressionScheme::cluster) return ClusterRouter{*this};
    return SuppressionRouter{*this};
}

namespace {

/// Threshold of a scheme: its default, the numbers that it may be, and the range in an error.
struct Threshold {
    double usual, low, high;
    bool is_whole;
    std::string_view range;
};
Threshold threshold_of(SuppressionScheme scheme) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (scheme) {
        case SuppressionScheme::counter:
            return {3, 1, 1e9, true, "a whole number from 1 to 1e9 for scheme \"counter\""};
        case SuppressionScheme::probability:
            return {0.7, 0, 1, false, "from 0 to 1 for scheme \"probability\""};
        case SuppressionScheme::distance:
            return {40, 0, infinity, false, ">= 0 m for scheme \"distance\""};
        case SuppressionScheme::location:
            return {0.05, 0, 1, false, "from 0 to 1 for scheme \"location\""};
        case SuppressionScheme::cluster: break;
    }
    return {};
}

/// Threshold of the settings, checked.
double checked_threshold(const Suppression& settings) {
    const Threshold rule = threshold_of(settings.scheme);
    const double given = settings.threshold.value_or(rule.usual);
    const bool is_whole = given == std::floor(given);
    if (given < rule.low || given > rule.high || (rule.is_whole && !is_whole))
        throw_out_of_range("suppression", "threshold", rule.range, given);
    return given;
}

}  // namespace

SuppressionRouter::SuppressionRouter(const Suppression& suppression) : settings_(suppression) {
    check_fields(suppression, "suppression");
    threshold_ = checked_threshold(suppression);
    if (suppression.scheme == SuppressionScheme::location && !suppression.range)
        throw_out_of_range("suppression", "range", "> 0 m for scheme \"location\"", unset);
}

/// Allocates the states of a message at all nodes.
void SuppressionRouter::make_room(std::size_t message, std::size_t nodes) {
    if (known_.size() <= message) known_.resize(message + 1);
    known_[message].resize(nodes, waits_matter());
}

void SuppressionRouter::send(LinkLayer& link, NodeId node, MessageId message) {
    known(link, message).decide(node);
    link.send({.message = message,
               .sender = node,
               .path = link.key(node),
               .ttl = initial_ttl(),
               .hops = 1},
              std::nullopt, link.now());
}

void SuppressionRouter::on_receive(LinkLayer& link, const Frame& frame,
                                   std::span<Reception> receptions) {
    Known& known = this->known(link, frame.message);
    // Each packet tells its sender's place, so that its receivers know it.
    const Heard heard{frame, places_matter() ? link.position(frame.sender) : Vec3{}};
    news_.clear();
    Reception** next = news_.room(receptions.size());
    for (Reception& reception : receptions) {
        reception.delivered = false;
        reception.fate = Fate::duplicate;
        *next = &reception;
        next += !known.is_decided(reception.node);
    }
    news_.keep_to(next);
    const std::span<Reception*> news = news_.kept();
    if (waits_matter()) {
        for (const Reception* r : news) __builtin_prefetch(&known.wait_of[r->node.index()]);
    }
    const auto end = std::remove_if(news.begin(), news.end(), [&](const Reception* r) {
        return waits_matter() && hear_again(link, heard, known, r->node);
    });
    sort_by_keys(link, {news.begin(), end});
    for (auto each = news.begin(); each != end; ++each) take(link, heard, known, **each);
}

/// First copy of a message at a node.
void SuppressionRouter::take(LinkLayer& link, const Heard& heard, Known& known, Reception& r) {
    r.delivered = true;
    Wait wait;
    if (heard.frame.ttl <= 1 || suppresses(link, heard, known, wait, r.node)) {
        r.fate = heard.frame.ttl <= 1 ? Fate::ttl : Fate::arrived;
        return known.decide(r.node);
    }
    r.fate = Fate::waiting;
    const double u = link.draw(Purpose::assessment, r.node, heard.frame.message, 0);
    const QueuedFrame copy = passed_on(link, heard.frame, r.node);
    wait.copy = link.send(copy.frame, copy.heard_from,
                          r.time + least_reaction + from_seconds(u * seconds(settings_.delay)))
                    .value();
    if (!waits_matter()) return known.decide(r.node);
    known.waits.push_back(wait);
    known.wait_of[r.node.index()] = static_cast<std::uint32_t>(known.waits.size());
}

/// Notes a further copy at a node whose own copy waits, or was sent. @return whether it is further
bool SuppressionRouter::hear_again(LinkLayer& link, const Heard& heard, Known& known, NodeId node) {
    const std::uint32_t number = known.wait_of[node.index()];
    if (number == 0) return false;
    Wait& wait = known.waits[number - 1];
    if (settings_.scheme == SuppressionScheme::counter && wait.copies + 1 < threshold_) {
        ++wait.copies;  // whether the copy was sent matters only once there are enough
        return true;
    }
    const QueuedFrame* copy = link.waiting(wait.copy);
    const bool is_sent =
        !copy || copy->frame.message != heard.frame.message || copy->frame.sender != node;
    if (is_sent || suppresses(link, heard, known, wait, node)) {
        if (!is_sent) link.cancel(wait.copy);
        known.decide(node);
    }
    return true;
}

/// Notes a copy. @return whether the node now knows that it need not forward the message
bool SuppressionRouter::suppresses(LinkLayer& link, const Heard& heard, Known& known, Wait& wait,
                                   NodeId node) {
    switch (settings_.scheme) {
        case SuppressionScheme::counter: return ++wait.copies >= threshold_;
        case SuppressionScheme::probability:
            return link.draw(Purpose::assessment, node, heard.frame.message, 1) >= threshold_;
        case SuppressionScheme::distance:
            return squared_distance(heard.from, link.position(node)) < threshold_ * threshold_;
        case SuppressionScheme::location:
            return is_covered(heard, known, wait, link.position(node));
        case SuppressionScheme::cluster: break;
    }
    return false;
}

/// Notes the sender's place. @return whether the senders heard leave less than A of the node's disc
bool SuppressionRouter::is_covered(const Heard& heard, Known& known, Wait& wait, Vec3 here) {
    known.senders.push_back({heard.from, wait.last_sender});
    wait.last_sender = static_cast<std::uint32_t>(known.senders.size());
    senders_.clear();
    for (std::uint32_t i = wait.last_sender; i != 0; i = known.senders[i - 1].before)
        senders_.push_back(known.senders[i - 1].at - here);
    return uncovered_share(senders_, settings_.range->value) < threshold_;
}

void SuppressionRouter::forget(MessageId message) {
    if (message.index() < known_.size()) known_[message.index()] = {};  // and its memory
}

}  // namespace rovernet
