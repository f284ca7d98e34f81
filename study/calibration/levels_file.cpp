// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"
#include "files/csv_table.hpp"
#include "files/text_source.hpp"
#include "files/word.hpp"
#include "models/link_gain.hpp"
#include "study/calibration/known_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

namespace rovernet {
namespace {

/// Reads the lines of a file of levels by the names of their columns.
class LevelsReader {
  public:
    LevelsReader(const std::string& path, const Radio& radio, std::optional<Dbm> floor,
                 Receivers receivers)
        : lines_(TextSource(path, TextSource::Reads::once)), radio_(radio), floor_(floor) {
        read_head(receivers);
    }

    void read(KnownLinks& out) {
        while (const auto line = next()) {
            words_ = csv_fields(*line);
            if (words_.size() != columns_) {
                throw InputError(lines_.where(),
                                 fmt::format("found {} fields; expected {}, as in the first line",
                                             words_.size(), columns_));
            }
            out.links.push_back(link());
        }
        out.groups = groups_.size();
        if (column("group")) out.group_name = "group";
        out.knows_receivers = column("to_x_m").has_value();
        if (out.links.empty())
            throw InputError(lines_.where(),
                             "this file contains no level; expected at least one line below the "
                             "names of the columns");
    }

  private:
    static constexpr std::array<std::string_view, 9> known{"from_x_m",  "from_y_m", "from_z_m",
                                                           "to_x_m",    "to_y_m",   "to_z_m",
                                                           "level_dbm", "group",    "place"};

    /// The next line that is neither empty nor a comment.
    std::optional<std::string_view> next() {
        for (;;) {
            const auto line = lines_.next();
            if (!line || (!line->empty() && line->front() != '#')) return line;
        }
    }

    void read_head(Receivers receivers) {
        const auto line = next();
        if (!line)
            throw InputError(lines_.where(),
                             "this file is empty; expected a first line with the names of the "
                             "columns, such as from_x_m,from_y_m,to_x_m,to_y_m,level_dbm");
        const std::vector<Word> names = csv_fields(*line);
        columns_ = names.size();
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto at = std::find(known.begin(), known.end(), names[i].text);
            if (at != known.end()) column_[static_cast<std::size_t>(at - known.begin())] = i;
        }
        const bool by_place = receivers == Receivers::may_be_unknown && !column("to_x_m") &&
                              !column("to_y_m") && column("place");
        for (const std::string_view needed :
             {"from_x_m", "from_y_m", "level_dbm", "to_x_m", "to_y_m"}) {
            if (column(needed) || (by_place && needed.starts_with("to_"))) continue;
            throw InputError(
                lines_.where(),
                fmt::format("no column \"{}\"; expected at least the columns from_x_m, from_y_m, "
                            "to_x_m, to_y_m{} and level_dbm",
                            needed,
                            receivers == Receivers::known
                                ? ""
                                : " (or the column \"place\" instead of to_x_m and to_y_m)"));
        }
    }

    std::optional<std::size_t> column(std::string_view name) const {
        return column_[static_cast<std::size_t>(std::find(known.begin(), known.end(), name) -
                                                known.begin())];
    }
    Vec3 place(std::string_view x, std::string_view y, std::string_view z) const {
        const auto metres = [&](std::string_view name) {
            const auto i = column(name);
            return i ? coordinate(words_[*i], lines_.where()) : 0;
        };
        return {metres(x), metres(y), metres(z)};
    }
    /// Level [dBm]: the noise of 1 Hz is -174 dBm, and no radio sends more than 100 dBm.
    double level_of(const Word& word) const {
        constexpr std::string_view expected = "a level from -300 to 100 [dBm]";
        const double dbm = any_number(word, lines_.where(), expected);
        if (!(dbm >= -300 && dbm <= 100)) fail_at(lines_.where(), word, expected);
        return dbm;
    }

    KnownLink link() {
        KnownLink link{.name = fmt::format("line {}", lines_.where().line),
                       .from = place("from_x_m", "from_y_m", "from_z_m"),
                       .to = place("to_x_m", "to_y_m", "to_z_m"),
                       .frequency = radio_.frequency,
                       .budget = link_budget(radio_, radio_).value};
        const Word level = words_[*column("level_dbm")];
        link.unseen = level.text.empty();
        if (link.unseen && !floor_) {
            throw InputError(lines_.where(),
                             "an empty level needs --floor, the level [dBm] below which nothing "
                             "was received");
        }
        const double dbm = link.unseen ? floor_->value : level_of(level);
        link.loss = received_power(radio_, radio_, Db{0}).value - dbm;
        const auto word = [&](std::string_view name) {
            const auto i = column(name);
            return i ? std::string(words_[*i].text) : std::string();
        };
        const auto text = [](Vec3 p) { return fmt::format("{} {} {}", p.x, p.y, p.z); };
        const bool knows_receiver = column("to_x_m").has_value();
        const std::string group = column("group")  ? word("group")
                                  : knows_receiver ? text(link.to)
                                                   : word("place");
        link.place = !knows_receiver   ? word("place")
                     : column("place") ? group + " " + word("place")
                                       : text(link.from) + " " + text(link.to);
        link.group =
            groups_.emplace(group, static_cast<std::uint32_t>(groups_.size())).first->second;
        return link;
    }

    TextLines lines_;
    const Radio& radio_;
    std::optional<Dbm> floor_;
    std::size_t columns_ = 0;
    std::array<std::optional<std::size_t>, known.size()> column_;
    std::vector<Word> words_;
    std::map<std::string, std::uint32_t> groups_;
};

}  // namespace

KnownLinks read_levels(const std::string& path, const Scenario& scenario, std::optional<Dbm> floor,
                       Receivers receivers) {
    refuse_doors(scenario.scene, "a comparison with levels");
    const NetworkSettings settings = network_settings(scenario);
    KnownLinks out;
    out.group_name = "receiver";
    out.measured = true;
    out.scene = settings.scene ? settings.scene : std::make_shared<Scene>();
    out.floor_height = settings.floor_height;
    out.seed = scenario.scenario.seed;
    LevelsReader(path, scenario.radio, floor, receivers).read(out);
    return out;
}

Repeatability repeatability(const KnownLinks& first, const KnownLinks& second) {
    Repeatability out;
    std::map<std::string, double> losses;  // the first of each place
    double squares = 0;
    for (const KnownLinks* known : {&first, &second}) {
        for (const KnownLink& link : known->links) {
            if (link.unseen || link.place.empty()) continue;
            const auto [at, is_new] = losses.emplace(link.place, link.loss);
            if (is_new) continue;
            squares += (link.loss - at->second) * (link.loss - at->second);
            ++out.levels;
        }
    }
    if (out.levels > 0) out.rms = std::sqrt(squares / static_cast<double>(out.levels));
    return out;
}

}  // namespace rovernet
