// SPDX-License-Identifier: MIT
#include "scenario/document/simulator_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

namespace rovernet {
namespace {

/// Name elsewhere, as plain() returns it, of something that has a different name here.
struct Synonym {
    std::string_view name, here;
    std::string_view also = {};  ///< keys that the model needs for the same result
};

constexpr Synonym synonyms[] = {
    // [propagation] model
    {"range", "disc"},
    {"unitdisc", "disc"},
    {"unitdisk", "disc"},
    {"unitdiskradio", "disc"},
    {"freespace", "friis"},
    {"tworayground", "two_ray"},
    {"tworaygroundreflection", "two_ray"},
    {"itur1238", "itu_indoor"},
    {"p1238", "itu_indoor"},
    {"lognormal", "log_distance", "exponent and sigma"},
    {"lognormalshadowing", "log_distance", "exponent and sigma"},
    {"shadowing", "log_distance", "exponent and sigma"},
    {"cost231multiwall", "multi_wall"},
    {"keenanmotley", "multi_wall"},
    {"motleykeenan", "multi_wall"},
    {"raytracer", "rays"},
    {"raytracing", "rays"},
    // [reception] model
    {"nisterrorrate", "sinr"},
    {"yanserrorrate", "sinr"},
    // [access] model
    {"80211", "csma"},
    {"adhocwifi", "csma"},
    {"csmaca", "csma"},
    {"dcf", "csma"},
    {"wifi", "csma"},
    {"slottedaloha", "aloha", "slot"},
    // [routing] protocol
    {"flooding", "flood"},
    {"meshtastic", "managed"},
    // move = { model = ... }
    {"constantposition", "fixed"},
    {"static", "fixed"},
    {"stationary", "fixed"},
    {"waypoint", "waypoints"},
    {"randomwalk2d", "random_walk"},
    {"randomdirection2d", "random_direction"},
    {"referencepointgroup", "group"},
    {"rpgm", "group"},
};

/// Name elsewhere of something that a different table chooses.
struct Elsewhere {
    std::string_view name;
    std::string_view among;  ///< a valid word of the table where the name is found
    std::string_view here;
};

constexpr Elsewhere elsewhere[] = {
    {"nakagami", "friis", "[fading] model = \"nakagami\""},
    {"rayleigh", "friis", "[fading] model = \"rayleigh\""},
    {"ricean", "friis", "[fading] model = \"rician\""},
    {"rician", "friis", "[fading] model = \"rician\""},
};

/// Names elsewhere of what rovernet does not have.
constexpr std::string_view missing_path_losses[] = {"cost231",     "cost231hata",     "hata",
                                                    "longleyrice", "okumurahata",     "okumura",
                                                    "itm",         "threelogdistance"};
constexpr std::string_view missing_access[] = {"802154", "bmac", "lmac", "lrwpan",
                                               "smac",   "tdma", "tsch", "xmac"};
constexpr std::string_view missing_protocols[] = {"batman", "dsdv", "dymo", "gpsr", "hwmp",
                                                  "olsr",   "rpl",  "tora", "zrp"};

struct Missing {
    std::string_view among;  ///< a valid word of the table where the names are found
    std::span<const std::string_view> names;
};

constexpr Missing missing[] = {
    {"friis", missing_path_losses}, {"csma", missing_access}, {"aodv", missing_protocols}};

/// Letters and digits of a name in small letters, without the prefixes and suffixes of the classes
/// of ns-2, ns-3 and OMNeT++: "friis" of "ns3::FriisPropagationLossModel".
std::string plain(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
    }
    for (const std::string_view prefix : {"ns3", "propagation", "mac", "ieee"})
        if (out.starts_with(prefix) && out.size() > prefix.size()) out.erase(0, prefix.size());
    for (const std::string_view suffix : {"helper", "medium", "model", "mac", "propagationloss",
                                          "mobility", "pathloss", "fading", "protocol"})
        // A name such as LMac stays whole.
        if (out.ends_with(suffix) && out.size() > suffix.size() + 1)
            out.erase(out.size() - suffix.size());
    return out;
}

bool contains(const auto& words, std::string_view word) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

}  // namespace

std::string simulator_name_hint(std::string_view word, const std::vector<std::string>& choices) {
    constexpr std::size_t longest_name = 64;
    const std::string name = word.size() > longest_name ? "" : plain(word);
    if (name.empty()) return "";
    for (const std::string& choice : choices)
        if (plain(choice) == name) return fmt::format("did you mean \"{}\"?", choice);
    for (const auto& [known, here, also] : synonyms) {
        if (known != name || !contains(choices, here)) continue;
        return fmt::format("did you mean \"{}\"{}{}?", here, also.empty() ? "" : ", with ", also);
    }
    for (const auto& [known, among, here] : elsewhere)
        if (known == name && contains(choices, among)) return fmt::format("did you mean {}?", here);
    for (const auto& [among, names] : missing)
        if (contains(names, name) && contains(choices, among))
            return fmt::format(
                "{} is not available: \"rovernet help not-there\" lists what to use instead", word);
    return "";
}

}  // namespace rovernet
